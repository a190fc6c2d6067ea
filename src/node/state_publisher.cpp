#include "interpolated_motion_driver/node/state_publisher.h"

#include "interpolated_motion_driver/node/message_conversion.h"

namespace interpolated_motion::node {

StatePublisher::StatePublisher(ros::NodeHandle node, const HardwareThread& hardware)
    : hardware_(hardware),
      state_publisher_(node.advertise<control_msgs::JointTrajectoryControllerState>("state", 1)),
      joint_state_publisher_(ros::NodeHandle().advertise<sensor_msgs::JointState>("joint_states", 1)) {}

void StatePublisher::publish() {
  hardware_.snapshot(snapshot_);
  if (snapshot_.state == motion::GroupState::Starting) return;
  fill_state(snapshot_, state_);
  state_publisher_.publish(state_);
  fill_joint_state(snapshot_, joint_state_);
  if (!joint_state_.name.empty()) joint_state_publisher_.publish(joint_state_);
}

}  // namespace interpolated_motion::node
