#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// One point of a goal, as in trajectory_msgs/JointTrajectoryPoint: values in the order of the goal's joint
/// names. Empty vectors mean that the goal does not say.
struct Waypoint {
  GoalTime time{0.0};  ///< since the start of the trajectory
  std::vector<double> positions;
  std::vector<double> velocities;
  std::vector<double> accelerations;
  std::vector<double> efforts;
};

/// As control_msgs/JointTolerance: a positive value sets the tolerance, 0 keeps the default, a negative one
/// erases it.
struct JointTolerance {
  std::string joint;
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
};

/// A FollowJointTrajectory goal, or a trajectory of the command topic, without ROS types.
struct Goal {
  std::vector<std::string> joint_names;
  std::vector<Waypoint> points;
  /// Host time of goal time 0 (the message's stamp). Empty: as soon as possible (stamp 0).
  std::optional<HostTime> start;
  std::vector<JointTolerance> path_tolerance;
  std::vector<JointTolerance> goal_tolerance;
  double goal_time_tolerance = 0.0;  ///< s; 0 keeps the default, a negative value erases it
};

/// Limits of a joint, in its own units (rad or m, per s, per s^2).
struct JointLimits {
  double min_position = -std::numeric_limits<double>::infinity();
  double max_position = std::numeric_limits<double>::infinity();
  double max_velocity = std::numeric_limits<double>::infinity();
  double max_acceleration = std::numeric_limits<double>::infinity();
  bool continuous = false;  ///< the position wraps around at 2 pi (URDF type `continuous`)
};

}  // namespace interpolated_motion::trajectory
