#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/timed_paths.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "interpolated_motion_driver/trajectory/tolerances.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// How the active goal ends once the group is at rest.
struct Ending {
  GoalOutcome outcome = GoalOutcome::Aborted;  ///< of its GoalResult
  Refusal reason;  ///< code and text of its GoalResult; empty text where it succeeds
};

inline Ending replaced_by_goal() {
  return {GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a newer goal."}};
}

/// A goal that the drives execute, or are being loaded for, or that is paused.
struct ActiveGoal {
  GoalId id = 0;                      ///< as in its GoalAcceptance
  trajectory::Tolerances tolerances;  ///< the goal's own over those of the configuration
  GoalTime lead_in{0.0};              ///< as in its plan
  GoalTime duration{0.0};             ///< as in its plan
  GoalTime zero{0.0};                 ///< nominal time of the course at time 0 of the goal's plan
  GoalTime end{0.0};                  ///< nominal time of the course at which all joints stand
  bool lingers = false;               ///< there the drives stay under way; else they leave
  TimedPaths course;                  ///< until the motion begins, or where it is to go on after a pause
  std::uint64_t speeds = 0;           ///< SpeedControl::orders() that the course stands for
  std::optional<Ending> ending;       ///< it is being stopped on its path, and ends so
  HostTime start{};                   ///< earliest host time at which the motion may begin
  HostTime set_out{};                 ///< when the drives are told, to begin then
  bool begin_is_set = false;          ///< every axis has been told when its path begins
  std::string remark;                 ///< goes with its success: what was not done to the letter
  HostTime ended = kNever;            ///< when the last drive had played its records

  /// Until then the joints must be within their goal tolerances; `settle_timeout`: for a goal that does not
  /// say.
  HostTime settle_deadline(HostDuration settle_timeout) const {
    const HostDuration goal_time = host_duration(tolerances.goal_time.count());
    return ended + (goal_time > HostDuration::zero() ? goal_time : settle_timeout);
  }
};

/// The goal that has moved last, for the motion report.
struct LastMotion {
  GoalId goal = 0;         ///< 0: a stream of setpoints
  GoalTime duration{0.0};  ///< its lead-in included
};

/// A goal that has been accepted while the group comes to rest, and the drives can no longer be told anything
/// else; it is planned from where the group stops.
struct PendingGoal {
  GoalId id = 0;                ///< as in its GoalAcceptance
  GoalPtr goal;                 ///< where the rest was not known, not known yet to be possible from there
  bool sent_in_motion = false;  ///< the drives were braking by themselves
  PlanningPtr planning;         ///< from the rest, once the group is there
};

}  // namespace interpolated_motion::motion
