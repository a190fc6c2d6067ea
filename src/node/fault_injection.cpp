#include "interpolated_motion_driver/node/fault_injection.h"

#include <string>
#include <utility>

namespace interpolated_motion::node {

FaultInjection::FaultInjection(ros::NodeHandle node, HardwareThread& hardware)
    : hardware_(hardware), server_(node.advertiseService("inject_fault", &FaultInjection::inject, this)) {}

bool FaultInjection::inject(Service::Request& request, Service::Response& response) {
  using Answer = std::pair<bool, std::string>;
  const auto answer =
      hardware_.call([joint = request.joint, command = request.command](auto& hardware, HostTime now) {
        Answer result;
        result.first = hardware.inject(joint, command, &result.second, now);
        return result;
      });
  if (!answer) return false;
  response.success = static_cast<std::uint8_t>(answer->first);
  response.message = answer->second;
  return true;
}

}  // namespace interpolated_motion::node
