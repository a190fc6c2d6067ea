#pragma once

#include <optional>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "interpolated_motion_driver/trajectory/tolerances.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// A goal whose records are in the drives, or on the way there.
struct ActiveGoal {
  GoalId id = 0;
  trajectory::GoalPlan plan;
  trajectory::Tolerances tolerances;
  HostTime start{};           ///< earliest host time at which the motion may begin
  HostTime started = kNever;  ///< when the start command was sent
  bool begin_is_set = false;  ///< every axis has been told when its path begins
  HostTime ended = kNever;    ///< when the last drive had played its records
};

/// A goal that has been accepted while another one is being brought to rest; it is planned from where the
/// group stops.
struct PendingGoal {
  GoalId id = 0;
  trajectory::Goal goal;
};

/// How the active goal ends once the group is at rest.
struct Ending {
  GoalOutcome outcome = GoalOutcome::Aborted;
  Refusal reason;
};

}  // namespace interpolated_motion::motion
