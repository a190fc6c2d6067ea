#include "interpolated_motion_driver/node/control_services.h"

#include <utility>

#include <boost/function.hpp>

namespace interpolated_motion::node {
namespace {

/// Longer than any request may take by its own time limits, so that it normally answers itself.
constexpr HostDuration kPatience = std::chrono::seconds(15);

}  // namespace

ControlServices::ControlServices(ros::NodeHandle node, ros::NodeHandle halt_node, HardwareThread& hardware,
                                 const hardware::RecorderConfiguration& recorder)
    : hardware_(hardware), speed_(node, hardware), recordings_(node, hardware, recorder) {
  enable_ = node.advertiseService("enable", &ControlServices::enable, this);
  reset_faults_ = advertise_trigger(node, "reset_faults",
                                    [](auto& drives, HostTime now) { return drives.reset_faults(now); });
  halt_ = advertise_trigger(halt_node, "halt", [](auto& drives, HostTime now) { return drives.halt(now); });
  clear_buffers_ = advertise_trigger(node, "clear_buffers",
                                     [](auto& drives, HostTime now) { return drives.clear_buffers(now); });
}

ros::ServiceServer ControlServices::advertise_trigger(ros::NodeHandle& node, const std::string& name,
                                                      Start start) {
  using Trigger = std_srvs::Trigger;
  boost::function<bool(Trigger::Request&, Trigger::Response&)> serve =
      [this, start = std::move(start)](Trigger::Request&, Trigger::Response& response) {
        const motion::RequestResult result = hardware_.request(start, kPatience);
        response.success = static_cast<std::uint8_t>(result.success);
        response.message = result.message;
        return true;
      };
  return node.advertiseService<Trigger::Request, Trigger::Response>(name, serve);
}

bool ControlServices::enable(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  const bool on = request.data != 0;
  const motion::RequestResult result =
      hardware_.request([on](auto& drives, HostTime now) { return drives.enable(on, now); }, kPatience);
  response.success = static_cast<std::uint8_t>(result.success);
  response.message = result.message;
  return true;
}

}  // namespace interpolated_motion::node
