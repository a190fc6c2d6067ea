#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"

#include <algorithm>

#include <fmt/format.h>

namespace interpolated_motion::axis {

using silverlode::Outcome;

void SegmentDelivery::give_up() {
  device().withdraw_bulk();
  forget_command();
}

bool SegmentDelivery::send(const silverlode::Request& request, HostTime deadline) {
  id_ = device().offer_bulk(request, deadline);
  return sending();
}

double wanted_at(const std::vector<double>& begins, std::size_t i, double horizon) {
  if (i < kLeastAhead) return 0.0;
  return std::max(0.0, std::min(begins[i] - horizon, begins[i - kLeastAhead]));
}

SegmentDelivery::Steps write_and_verify(const silverlode::DeviceLink& device, std::uint16_t number,
                                        std::int32_t value, const char* purpose) {
  const auto check = [&device, number, value, purpose](const Outcome& outcome) -> std::optional<std::string> {
    const auto read = outcome.register_value();
    if (!read) return device.text(outcome);
    if (*read == value) return std::nullopt;
    return fmt::format("register {} ({}) was set to {} but the drive has {}", number, purpose, value, *read);
  };
  return {{silverlode::wri_request(device.address(), number, value), {}},
          {silverlode::rrg_request(device.address(), number), check}};
}

}  // namespace interpolated_motion::axis
