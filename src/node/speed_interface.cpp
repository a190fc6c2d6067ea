#include "interpolated_motion_driver/node/speed_interface.h"

#include <fmt/format.h>
#include <ros/console.h>
#include <boost/function.hpp>

namespace interpolated_motion::node {

SpeedInterface::SpeedInterface(ros::NodeHandle node, HardwareThread& hardware)
    : hardware_(hardware),
      pause_(advertise(node, "pause", true)),
      resume_(advertise(node, "resume", false)),
      set_override_(node.advertiseService("set_speed_override", &SpeedInterface::set_override, this)),
      input_(node.subscribe("speed_scaling_input", 1, &SpeedInterface::on_input, this)) {}

ros::ServiceServer SpeedInterface::advertise(ros::NodeHandle& node, const std::string& name, bool paused) {
  using Trigger = std_srvs::Trigger;
  boost::function<bool(Trigger::Request&, Trigger::Response&)> serve =
      [this, paused](Trigger::Request&, Trigger::Response& response) {
        const auto refused = order({std::nullopt, paused});
        response.success = static_cast<std::uint8_t>(!refused);
        response.message = refused  ? *refused
                           : paused ? "paused: a goal under way comes to rest on its way, and no other begins"
                                    : "goals go on";
        return true;
      };
  return node.advertiseService<Trigger::Request, Trigger::Response>(name, serve);
}

bool SpeedInterface::set_override(Override::Request& request, Override::Response& response) {
  const auto refused = order({request.speed_override, std::nullopt});
  response.success = static_cast<std::uint8_t>(!refused);
  response.message = refused ? *refused : fmt::format("speed override {:g}", request.speed_override);
  return true;
}

void SpeedInterface::on_input(const std_msgs::Float64& message) {
  if (const auto refused = order({message.data, std::nullopt}))
    ROS_WARN_STREAM_THROTTLE(1.0, "speed_scaling_input ignored: " << *refused);
}

/// Why it is not done; nothing if it is.
std::optional<std::string> SpeedInterface::order(const motion::SpeedOrder& order) {
  const auto answer = hardware_.call(
      [order](HardwareThread::Hardware& hardware, HostTime now) { return hardware.order_speed(order, now); });
  if (!answer) return "The driver is shutting down.";
  if (*answer) return (*answer)->text;
  return std::nullopt;
}

}  // namespace interpolated_motion::node
