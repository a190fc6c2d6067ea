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
  GoalId id = 0;                      ///< as in its GoalAcceptance
  trajectory::GoalPlan plan;          ///< whole, one path per joint, rest to rest
  trajectory::Tolerances tolerances;  ///< the goal's own over those of the configuration
  HostTime start{};                   ///< earliest host time at which the motion may begin
  HostTime started = kNever;          ///< when the start command was sent
  bool begin_is_set = false;          ///< every axis has been told when its path begins
  HostTime ended = kNever;            ///< when the last drive had played its records
};

/// A goal that has been accepted while another one is being brought to rest; it is planned from where the
/// group stops.
struct PendingGoal {
  GoalId id = 0;          ///< as in its GoalAcceptance
  trajectory::Goal goal;  ///< checked in form only: that it can be executed is not known yet
};

/// How the active goal ends once the group is at rest.
struct Ending {
  GoalOutcome outcome = GoalOutcome::Aborted;  ///< of its GoalResult
  Refusal reason;  ///< code and text of its GoalResult; empty text where it succeeds
};

}  // namespace interpolated_motion::motion
