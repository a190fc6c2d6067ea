#pragma once

#include <optional>
#include <string>

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Trigger.h>

#include "interpolated_motion_driver/SetSpeedOverride.h"
#include "interpolated_motion_driver/node/hardware_thread.h"

namespace interpolated_motion::node {

/// How fast goals are gone along: the services `~pause`, `~resume` and `~set_speed_override`, and the latter
/// as a topic, `~speed_scaling_input` (std_msgs/Float64). The services answer at once: what they ask for has
/// begun, or is going to.
class SpeedInterface {
 public:
  /// Advertises and subscribes below `node`; calls come from its callback queue. `hardware` must live longer.
  SpeedInterface(ros::NodeHandle node, HardwareThread& hardware);

 private:
  using Override = interpolated_motion_driver::SetSpeedOverride;

  ros::ServiceServer advertise(ros::NodeHandle& node, const std::string& name, bool paused);
  bool set_override(Override::Request& request, Override::Response& response);
  void on_input(const std_msgs::Float64& message);
  std::optional<std::string> order(const motion::SpeedOrder& order);

  HardwareThread& hardware_;
  ros::ServiceServer pause_;
  ros::ServiceServer resume_;
  ros::ServiceServer set_override_;
  ros::Subscriber input_;
};

}  // namespace interpolated_motion::node
