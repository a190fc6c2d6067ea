#pragma once

#include <map>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "interpolated_motion_driver/hardware/bus_configuration.h"
#include "interpolated_motion_driver/hardware/drive_configuration.h"
#include "interpolated_motion_driver/hardware/drive_kinds.h"
#include "interpolated_motion_driver/hardware/recorder_configuration.h"
#include "interpolated_motion_driver/motion/setpoint.h"

namespace interpolated_motion::hardware {

/// Supervision of goals, named and meant as by joint_trajectory_controller.
struct ConstraintConfiguration {
  struct Joint {
    double trajectory = 0.0;  ///< rad or m, path tolerance; 0: none
    double goal = 0.0;        ///< rad or m, goal tolerance; 0: none
    double start = 0.05;      ///< rad or m, of a goal's first point at t = 0 against the present position
    double stopped_velocity = 0.01;  ///< rad/s or m/s that counts as standstill at the goal; 0: not checked
  };
  double goal_time = 0.0;               ///< s
  std::map<std::string, Joint> joints;  ///< by name; an entry for each joint once it has been parsed
};

struct Configuration {
  std::vector<std::string> joints;         ///< names and order of every published array
  std::vector<BusConfiguration> buses;     ///< in the order of the parameters
  std::vector<DriveConfiguration> drives;  ///< in the order of `joints`
  ConstraintConfiguration constraints;     ///< where a goal has no tolerances of its own
  /// s, 0..60: a goal that is cancelled comes to rest on its path in so long, or in what the limits allow; 0:
  /// as quickly as the drives brake, off its path.
  double stop_trajectory_duration = 0.0;
  double speed_ramp = 0.3;  ///< s in which the speed of a goal changes by 1 where the limits allow it
  bool allow_partial_joints_goal = false;  ///< goals may leave joints out, which then stay where they are
  bool join_late = false;                  ///< a first point that cannot be reached in time is met later
  double max_start_ahead = 3600.0;         ///< s from now to a goal's stamp; one further ahead is refused
  double commit_horizon = 0.5;             ///< s of motion kept in the drives' FIFOs
  double bring_up_timeout = 5.0;           ///< s for all drives to answer and be configured
  double settle_timeout = 0.5;  ///< s after the last record for the joints to settle, when goal_time is 0
  bool enable_on_start = true;  ///< power stages are switched on when all drives are configured
  motion::StreamParameters setpoints;     ///< how streams of setpoints are followed
  RecorderConfiguration flight_recorder;  ///< what is kept of the last seconds, and when it is written
  /// The parameters that all this was read from, YAML on one line, without the node's own.
  std::string source;
  UrdfLimits urdf;  ///< the limits it was read with

  /// The bus of a drive. Throws std::invalid_argument that names the parameter when there is none of that
  /// name.
  const BusConfiguration& bus_of(const DriveConfiguration& drive) const;
};

/// Reads the driver's part of the node's parameters (`joints`, `buses`, `drives`, `constraints`, ...).
/// `node_keys` are further top-level keys that the node itself reads. `urdf` holds limits by joint name;
/// joints that are not in it, or limits wider than the URDF's, are refused, as are unknown keys, wrong types
/// and values out of range: throws std::invalid_argument whose text names the parameter, the value, the
/// allowed range and what to do. `kinds`: those that a drive can be of.
Configuration parse_configuration(const YAML::Node& parameters, const UrdfLimits& urdf,
                                  const std::vector<std::string>& node_keys = {},
                                  const DriveKinds& kinds = drive_kinds());

}  // namespace interpolated_motion::hardware
