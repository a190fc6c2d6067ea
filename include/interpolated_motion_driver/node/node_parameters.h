#pragma once

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace interpolated_motion::node {

/// Parameters that the node itself reads; those of the driver below are hardware::Configuration. Ranges in
/// docs/configuration.md.
struct NodeParameters {
  double state_publish_rate = 50.0;   ///< Hz, of ~state and /joint_states
  double action_monitor_rate = 20.0;  ///< Hz, of the action's feedback
  double status_publish_rate = 10.0;  ///< Hz, of ~buffer_status and ~drive_states
  double loop_period = 0.02;          ///< s, the bus thread sleeps no longer than this
  int realtime_priority = 0;          ///< SCHED_FIFO priority of the bus thread; 0: the normal scheduler
  std::string wire_log;               ///< file for all bus traffic; empty: none
  std::string
      robot_description_file;    ///< URDF file, used when no robot_description is on the parameter server
  std::string emulated_samples;  ///< folder of `emulated_drives --samples`; empty: none
  bool publish_tf = false;       ///< link frames on /tf
  std::string tf_demand_prefix = "demand/";  ///< of the trajectory's link frames; empty: none
  bool allow_fault_injection = false;        ///< offer ~inject_fault for emulated drives
  bool allow_parameter_writes = false;       ///< permit writing objects or registers of the drives
};

/// Reads the node's keys out of its private parameters. Throws std::invalid_argument that names parameter,
/// value and allowed range. Other keys are left to the driver below.
NodeParameters parse_node_parameters(const YAML::Node& parameters);

/// Every top-level key that is not the driver's: those of NodeParameters, those that ROS libraries read in a
/// node's private namespace, and those of joint_trajectory_controller that have no meaning here.
const std::vector<std::string>& node_parameter_keys();

/// Keys of a joint_trajectory_controller configuration that are present but have no meaning for drives that
/// close their own loops: `type`, `gains`, `velocity_ff`.
std::vector<std::string> ignored_controller_keys(const YAML::Node& parameters);

}  // namespace interpolated_motion::node
