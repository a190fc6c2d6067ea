#pragma once

#include <control_msgs/FollowJointTrajectoryFeedback.h>
#include <control_msgs/FollowJointTrajectoryGoal.h>
#include <control_msgs/FollowJointTrajectoryResult.h>
#include <control_msgs/JointTrajectoryControllerState.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <interpolated_motion_driver/BufferStatus.h>
#include <interpolated_motion_driver/DriveState.h>
#include <interpolated_motion_driver/GetMotionReport.h>

#include "interpolated_motion_driver/motion/results.h"
#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/trajectory/goal.h"

namespace interpolated_motion::node {

/// A trajectory of the command topic. A stamp of 0 means as soon as possible, any other is taken over to the
/// host clock.
trajectory::Goal to_goal(const trajectory_msgs::JointTrajectory& message);
/// A message of one point as a setpoint of `source`, which has arrived at `arrived`.
motion::Setpoint to_setpoint(const trajectory_msgs::JointTrajectory& message, std::string source,
                             HostTime arrived);
/// A goal of the action, with its tolerances.
trajectory::Goal to_goal(const control_msgs::FollowJointTrajectoryGoal& message);

/// The action's result: error_code as control_msgs defines it, error_string in a sentence.
control_msgs::FollowJointTrajectoryResult to_result(GoalError code, const std::string& text);
control_msgs::FollowJointTrajectoryResult to_result(const motion::GoalResult& result);

/// Fills a controller state as joint_trajectory_controller publishes it: desired with position, velocity and
/// acceleration, actual and error with position and velocity only. Vectors of the message are reused.
void fill_state(const motion::Snapshot& snapshot, control_msgs::JointTrajectoryControllerState& message);
/// The same for the action's feedback, which has the same fields.
void fill_state(const motion::Snapshot& snapshot, control_msgs::FollowJointTrajectoryFeedback& message);

/// Joints whose drive does not answer are left out: their positions are not known.
void fill_joint_state(const motion::Snapshot& snapshot, sensor_msgs::JointState& message);
/// All joints in the driver's order, vectors of the message reused.
void fill_buffer_status(const motion::Snapshot& snapshot, interpolated_motion_driver::BufferStatus& message);
void fill_drive_states(const motion::Snapshot& snapshot, interpolated_motion_driver::DriveState& message);
void fill_motion_report(const motion::MotionReport& report,
                        interpolated_motion_driver::GetMotionReport::Response& response);

}  // namespace interpolated_motion::node
