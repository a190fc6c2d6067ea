#include "interpolated_motion_driver/transport/host_clock.h"

#include <chrono>

namespace interpolated_motion::transport {

HostTime read_host_clock() {
  const auto since_boot = std::chrono::steady_clock::now().time_since_epoch();
  return HostTime(std::chrono::duration_cast<HostDuration>(since_boot));
}

HostDuration read_wall_clock() {
  return std::chrono::duration_cast<HostDuration>(std::chrono::system_clock::now().time_since_epoch());
}

}  // namespace interpolated_motion::transport
