#pragma once

#include <string>

namespace interpolated_motion {

/// Why a goal was not accepted, or why it ended without success. The values are those of
/// control_msgs/FollowJointTrajectoryResult, so that they go to the action's result as they are.
enum class GoalError {
  InvalidGoal = -1,
  InvalidJoints = -2,
  OldHeaderTimestamp = -3,
  PathToleranceViolated = -4,
  GoalToleranceViolated = -5,
};

/// A goal refused or aborted: the code and one text for the user. The text starts with the words
/// joint_trajectory_controller uses for the case, where it has any, and goes on with a sentence that names
/// joint, point, value, allowed range and what to do.
struct Refusal {
  GoalError code = GoalError::InvalidGoal;  ///< of the action's result
  std::string text;                         ///< for the user, as above
};

}  // namespace interpolated_motion
