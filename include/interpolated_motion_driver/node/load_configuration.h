#pragma once

#include <ros/node_handle.h>

#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/node/node_parameters.h"
#include "interpolated_motion_driver/node/robot_description.h"

namespace interpolated_motion::node {

/// Everything a node is configured with.
struct LoadedConfiguration {
  NodeParameters node;                 ///< what the node reads for itself: rates, topics, logs
  hardware::Configuration driver;      ///< buses, drives and limits, checked
  RobotDescription robot_description;  ///< where the limits came from
};

/// Reads the private parameters of the node (`private_node`) and the robot description: the parameter
/// `robot_description`, in the node's namespace or the nearest one above it, else the file named by
/// `robot_description_file`. Throws std::invalid_argument with parameter, value, allowed range and what to
/// do.
LoadedConfiguration load_configuration(const ros::NodeHandle& private_node);

}  // namespace interpolated_motion::node
