#pragma once

#include <control_msgs/JointTrajectoryControllerState.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/JointState.h>

#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/node/hardware_thread.h"

namespace interpolated_motion::node {

/// Publishes `~state`, and `joint_states` in the namespace that the node is in, once the drives have told
/// where they are.
class StatePublisher {
 public:
  /// Advertises; `hardware` must live longer.
  StatePublisher(ros::NodeHandle node, const HardwareThread& hardware);

  /// Publishes the latest snapshot, with its time as stamp; nothing while the drives are being looked for.
  void publish();

 private:
  const HardwareThread& hardware_;
  motion::Snapshot snapshot_;
  control_msgs::JointTrajectoryControllerState state_;
  sensor_msgs::JointState joint_state_;
  ros::Publisher state_publisher_;
  ros::Publisher joint_state_publisher_;
};

}  // namespace interpolated_motion::node
