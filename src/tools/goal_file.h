#pragma once

#include <string>

#include <trajectory_msgs/JointTrajectory.h>

namespace interpolated_motion::tools {

/// Reads a trajectory_msgs/JointTrajectory from YAML, as `rostopic echo` prints it: joint_names and points
/// with positions, velocities, accelerations, effort and time_from_start, as {secs, nsecs} or as a number of
/// seconds. Only what is written like this is checked here; whether it can be driven is the driver's
/// business. Throws std::runtime_error with file, point and key.
trajectory_msgs::JointTrajectory read_goal_file(const std::string& path);

}  // namespace interpolated_motion::tools
