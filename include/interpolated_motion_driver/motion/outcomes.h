#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/units/refusal.h"

namespace interpolated_motion::motion {

/// How goals have ended, each told once; and those without points, which end when the group is at rest.
class Outcomes {
 public:
  /// A name for the next goal that is accepted.
  GoalId next() { return next_++; }
  void end(GoalId goal, GoalOutcome outcome, Refusal reason);
  /// A request to stop, until end_stops().
  void add_stop(GoalId goal) { stops_.push_back(goal); }
  void end_stops(GoalOutcome outcome, const std::string& why = {});
  /// The next goal that has ended, oldest first.
  std::optional<GoalResult> take();

 private:
  GoalId next_ = 1;
  std::vector<GoalId> stops_;
  std::deque<GoalResult> results_;
};

}  // namespace interpolated_motion::motion
