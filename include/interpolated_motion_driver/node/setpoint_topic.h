#pragma once

#include <ros/ros.h>
#include <trajectory_msgs/JointTrajectory.h>

#include "interpolated_motion_driver/node/hardware_thread.h"

namespace interpolated_motion::node {

/// The topic `~setpoints`: a stream of trajectory_msgs/JointTrajectory with one point each, positions of all
/// joints and, if known, their velocities. The instant of a setpoint is header.stamp + time_from_start; stamp
/// 0 is the time of arrival. One publisher at a time. What is refused is logged, at most once a second.
class SetpointTopic {
 public:
  /// Subscribes below `node`; calls come from its callback queue. `hardware` must live longer.
  SetpointTopic(ros::NodeHandle node, HardwareThread& hardware);

 private:
  void on_setpoint(const ros::MessageEvent<const trajectory_msgs::JointTrajectory>& event);

  HardwareThread& hardware_;
  ros::Subscriber subscriber_;
};

}  // namespace interpolated_motion::node
