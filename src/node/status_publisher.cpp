#include "interpolated_motion_driver/node/status_publisher.h"

#include "interpolated_motion_driver/node/message_conversion.h"

namespace interpolated_motion::node {

StatusPublisher::StatusPublisher(ros::NodeHandle node, const HardwareThread& hardware)
    : hardware_(hardware),
      buffer_status_publisher_(node.advertise<interpolated_motion_driver::BufferStatus>("buffer_status", 1)),
      drive_states_publisher_(node.advertise<interpolated_motion_driver::DriveState>("drive_states", 1)),
      speed_publisher_(node.advertise<std_msgs::Float64>("speed_scaling", 1)) {}

void StatusPublisher::publish() {
  hardware_.snapshot(snapshot_);
  if (snapshot_.joints.empty()) return;
  fill_buffer_status(snapshot_, buffer_status_);
  buffer_status_publisher_.publish(buffer_status_);
  fill_drive_states(snapshot_, drive_states_);
  drive_states_publisher_.publish(drive_states_);
  std_msgs::Float64 speed;
  speed.data = snapshot_.speed.rate;
  speed_publisher_.publish(speed);
}

}  // namespace interpolated_motion::node
