#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/motion/active_goal.h"
#include "interpolated_motion_driver/motion/drives.h"
#include "interpolated_motion_driver/motion/execution.h"
#include "interpolated_motion_driver/motion/group_parameters.h"
#include "interpolated_motion_driver/motion/outcomes.h"
#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/speed_control.h"
#include "interpolated_motion_driver/trajectory/speed_change.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// From the wish for a motion to its execution: goals are planned from rest, behind what is committed, or
/// when the drives have come to rest, and so are changes of their speed. Whether the group takes goals at all
/// is up to the group.
class Goals {
 public:
  /// Both must outlive it.
  Goals(const GroupParameters& parameters, Drives& drives);

  // As Group's functions of these names, once the group takes goals.

  Expected<PlanningPtr, Refusal> begin(GoalPtr goal, GoalTime allowance, HostTime now);
  std::optional<Expected<GoalAcceptance, Refusal>> end(Planning& planning, HostTime now);
  Expected<PlanningPtr, Refusal> renew(const Planning& stale, GoalTime allowance, HostTime now);
  void drop_planning() { holding_ = false; }
  Planning::Premises premises() const;
  PlanningPtr take_planning(GoalTime allowance, HostTime now);
  bool may_plan() const { return pending_.has_value() || execution_.active().has_value(); }
  bool end_own(Planning& planning, HostTime now);
  void cancel(GoalId goal, HostTime now);
  std::optional<GoalResult> take_result() { return outcomes_.take(); }
  std::optional<Refusal> order_speed(const SpeedOrder& order, HostTime now);
  std::optional<std::string> take_note() { return speed_.take_note(); }

  /// Why setpoints are not taken now.
  std::optional<Refusal> refuse_setpoints() const;
  /// A goal waits for rest.
  bool has_waiting() const { return pending_.has_value(); }

  /// What is sent before counts no more.
  void count_order() { ++premises_.orders; }
  /// Nothing is left to be executed: `why` for what has not begun, `ending` for what has, which drives that
  /// move end by braking.
  void halt(const std::string& why, const Ending& ending, HostTime now);
  /// The drives stand after a stop.
  void end_stopped() { execution_.end_stopped(); }
  /// They are at rest, as asked for by goals without points.
  void end_stops() { outcomes_.end_stops(GoalOutcome::Succeeded); }
  /// A fault ends everything that is left at rest.
  void fail(const std::string& fault);

  Execution& execution() { return execution_; }
  const Execution& execution() const { return execution_; }
  /// What is due for the goal under way.
  void poll(HostTime now) { execution_.poll(has_waiting(), now); }

 private:
  PlanningPtr begin_now(GoalPtr goal, HostTime now) const;
  PlanningPtr begin_waiting(GoalPtr goal, HostTime now) const;
  PlanningPtr begin_speed_wanted(GoalTime allowance, HostTime now);
  PlanningPtr begin_speed(const trajectory::Speed& speed, GoalTime allowance, HostTime now);
  PlanningPtr take_waiting(HostTime now);
  void hold(GoalTime allowance);
  bool still_fits(const Planning& planning) const;

  GoalAcceptance start_from_rest(Planning& planning, HostTime now);
  GoalAcceptance join(Planning& planning, HostTime now);
  GoalAcceptance wait_for_rest(const Planning& planning, HostTime now);
  GoalAcceptance accept_stop(HostTime now);
  void end_waiting(Planning& planning, HostTime now);
  void take_speed(Planning& planning, HostTime now);
  void refuse_speed(const Planning& planning);

  void end_active(const Ending& ending, HostTime now);
  bool stop_on_path(const Ending& ending, HostTime now);
  void fail_waiting(const std::string& why, GoalOutcome outcome = GoalOutcome::Aborted);

  const GroupParameters& parameters_;
  Drives& drives_;
  SpeedControl speed_;
  Outcomes outcomes_;
  Execution execution_;
  Planning::Premises premises_;  ///< orders so far
  bool holding_ = false;         ///< while planning, for a goal that is to join
  std::optional<PendingGoal> pending_;
  std::optional<std::uint64_t> refused_;  ///< the order of a speed that was not possible in motion
};

}  // namespace interpolated_motion::motion
