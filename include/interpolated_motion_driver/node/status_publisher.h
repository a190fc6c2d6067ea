#pragma once

#include <interpolated_motion_driver/BufferStatus.h>
#include <interpolated_motion_driver/DriveState.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/Float64.h>

#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/node/hardware_thread.h"

namespace interpolated_motion::node {

/// Publishes `~buffer_status`, `~drive_states` and `~speed_scaling`, from the start of the node on.
class StatusPublisher {
 public:
  /// Advertises below `node`; `hardware` must live longer.
  StatusPublisher(ros::NodeHandle node, const HardwareThread& hardware);

  /// Publishes the latest snapshot, with its time as stamp.
  void publish();

 private:
  const HardwareThread& hardware_;
  motion::Snapshot snapshot_;
  interpolated_motion_driver::BufferStatus buffer_status_;
  interpolated_motion_driver::DriveState drive_states_;
  ros::Publisher buffer_status_publisher_;
  ros::Publisher drive_states_publisher_;
  ros::Publisher speed_publisher_;
};

}  // namespace interpolated_motion::node
