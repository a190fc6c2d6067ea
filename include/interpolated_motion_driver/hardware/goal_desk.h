#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "interpolated_motion_driver/motion/group.h"
#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// Has Planning::run() called somewhere, and MotionHardware::planned() afterwards on the thread that owns the
/// hardware. Returns at once.
using Planner = std::function<void(motion::PlanningPtr)>;

/// Names a goal until it is accepted or refused; never reused within a process.
using Ticket = std::uint64_t;

/// What has become of a goal that was handed in.
struct GoalAnswer {
  Ticket ticket = 0;
  motion::GoalPtr goal;
  Expected<motion::GoalAcceptance, Refusal> answer;
};

/// Where goals are handed in that are to be planned while the drives go on: one is being planned, one waits.
/// It has the goals planned by a Planner; without one on the spot, which may be told to take virtual time.
class GoalDesk {
 public:
  /// `group` must outlive the desk.
  explicit GoalDesk(motion::Group& group) : group_(group) {}

  /// Before the first goal.
  void set_planner(Planner planner) { planner_ = std::move(planner); }
  /// Without a planner: how long planning takes, >= 0.
  void set_planning_time(HostDuration time) { planning_time_ = time; }

  /// Hands in a goal. A request to stop is answered at once; of goals that wait the newest counts.
  Ticket submit(motion::GoalPtr goal, HostTime now);
  /// The goal is refused unless it has been answered.
  void withdraw(Ticket ticket);
  /// Does what is due: begins planning, also of a goal that has waited for rest.
  void poll(HostTime now);
  /// When poll() has something to do; kNever while planning or the group decides that.
  HostTime next_deadline() const;
  /// Planning that was given to the planner has run, and has taken so long.
  void planned(const motion::Planning& planning, HostDuration taken, HostTime now);
  /// The next answer, oldest first.
  std::optional<GoalAnswer> take_answer();

 private:
  struct Submission {
    Ticket ticket = 0;  ///< 0: a goal accepted already, which has waited for rest
    motion::GoalPtr goal;
    std::uint64_t orders = 0;  ///< of Group::premises(), when it was handed in
    int attempts = 0;
    motion::PlanningPtr planning;
    HostTime done = kNever;  ///< when virtual planning is over
  };

  bool begin_next(HostTime now);
  void begin_plan(HostTime now);
  void run(HostTime now);
  void end_plan(HostTime now);
  void answer(const Submission& submission, Expected<motion::GoalAcceptance, Refusal> answer);
  GoalTime allowance_for(const Submission& submission) const;
  GoalTime allowance_for_own() const;

  motion::Group& group_;
  Planner planner_;
  HostDuration planning_time_{0};
  Ticket next_ticket_ = 1;
  std::optional<Submission> current_;
  std::optional<Submission> waiting_;
  double seconds_per_point_ = 0.0;  ///< that planning took lately
  GoalTime last_planning_{0.0};     ///< what it took last
  int own_attempts_ = 0;            ///< at what the group has to plan
  std::deque<GoalAnswer> answers_;
};

}  // namespace interpolated_motion::hardware
