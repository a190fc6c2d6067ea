#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "interpolated_motion_driver/trajectory/joint_unit.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// One point of a goal, as in trajectory_msgs/JointTrajectoryPoint: values in the order of the goal's joint
/// names. Empty vectors mean that the goal does not say.
struct Waypoint {
  GoalTime time{0.0};                 ///< since the start of the trajectory
  std::vector<double> positions;      ///< rad or m
  std::vector<double> velocities;     ///< per s
  std::vector<double> accelerations;  ///< per s^2
  std::vector<double> efforts;        ///< only their number is checked, and that they are finite
};

/// As control_msgs/JointTolerance: a positive value sets the tolerance, 0 keeps the default, a negative one
/// erases it.
struct JointTolerance {
  std::string joint;          ///< of several entries for one joint each is applied in turn
  double position = 0.0;      ///< rad or m
  double velocity = 0.0;      ///< per s
  double acceleration = 0.0;  ///< per s^2
};

/// A FollowJointTrajectory goal, or a trajectory of the command topic, without ROS types.
struct Goal {
  std::vector<std::string> joint_names;  ///< in any order, none twice
  std::vector<Waypoint> points;          ///< times ascending; none: a request to stop
  /// Host time of goal time 0 (the message's stamp). Empty: as soon as possible (stamp 0).
  std::optional<HostTime> start;
  std::vector<JointTolerance> path_tolerance;
  std::vector<JointTolerance> goal_tolerance;
  double goal_time_tolerance = 0.0;  ///< s; 0 keeps the default, a negative value erases it
};

/// Limits of a joint, in its own units (rad or m, per s, per s^2).
struct JointLimits {
  double min_position = -std::numeric_limits<double>::infinity();  ///< of a continuous joint without meaning
  double max_position = std::numeric_limits<double>::infinity();   ///< of a continuous joint without meaning
  double max_velocity = std::numeric_limits<double>::infinity();   ///< magnitude, > 0
  double max_acceleration = std::numeric_limits<double>::infinity();  ///< magnitude, > 0
  bool continuous = false;             ///< the position wraps around at 2 pi (URDF type `continuous`)
  JointUnit unit = JointUnit::Radian;  ///< of all the values here; metres: a prismatic joint
  /// How far (rad or m) a position may be beyond its limits, for what is left of a value at the limit after
  /// printing and rounding; of a drive some encoder counts.
  double position_slack = 1e-6;
  /// How far a plan's velocity and acceleration may be beyond their limits, as a part of them, for the same
  /// reason (toppra gives 2.5000147 at a limit of 2.5).
  double rate_slack = 1e-4;
};

}  // namespace interpolated_motion::trajectory
