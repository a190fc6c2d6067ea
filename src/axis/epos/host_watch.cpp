#include "interpolated_motion_driver/axis/epos/host_watch.h"

#include <algorithm>
#include <cstdint>

#include "interpolated_motion_driver/axis/cia402/sdo_steps.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

namespace {

/// Node and ms; 0 ms: the drive does not watch.
SdoSequence::Step watch_host(const EposAxisParameters& parameters, HostDuration patience) {
  constexpr std::int64_t kLongest = 0xFFFF;
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(patience).count();
  const auto node = static_cast<std::uint32_t>(parameters.host_node_id) << 16;
  return sdo_steps::write_u32(cia402::object::kConsumerHeartbeat1,
                              node | static_cast<std::uint32_t>(std::min<std::int64_t>(ms, kLongest)));
}

}  // namespace

SdoSequence::Step watch_host_in_motion(const EposAxisParameters& parameters) {
  return watch_host(parameters, parameters.host_watch);
}

SdoSequence::Step watch_host_at_rest(const EposAxisParameters& parameters) {
  return watch_host(parameters, parameters.host_watch_at_rest);
}

}  // namespace interpolated_motion::axis
