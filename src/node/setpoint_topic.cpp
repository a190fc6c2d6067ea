#include "interpolated_motion_driver/node/setpoint_topic.h"

#include <utility>

#include "interpolated_motion_driver/node/clock.h"
#include "interpolated_motion_driver/node/message_conversion.h"

namespace interpolated_motion::node {
namespace {

constexpr std::uint32_t kQueue = 10;  // messages

}  // namespace

SetpointTopic::SetpointTopic(ros::NodeHandle node, HardwareThread& hardware) : hardware_(hardware) {
  subscriber_ = node.subscribe("setpoints", kQueue, &SetpointTopic::on_setpoint, this);
}

void SetpointTopic::on_setpoint(const ros::MessageEvent<const trajectory_msgs::JointTrajectory>& event) {
  const auto& message = *event.getConstMessage();
  if (message.points.size() != 1) {
    ROS_WARN_STREAM_THROTTLE(1.0, "setpoint ignored: it has " << message.points.size() << " points, not one");
    return;
  }
  motion::Setpoint setpoint = to_setpoint(message, event.getPublisherName(), host_now());
  const auto answer = hardware_.call([setpoint = std::move(setpoint)](auto& hardware, HostTime now) {
    return hardware.setpoint(setpoint, now);
  });
  if (answer && *answer) ROS_WARN_STREAM_THROTTLE(1.0, "setpoint ignored: " << (*answer)->text);
}

}  // namespace interpolated_motion::node
