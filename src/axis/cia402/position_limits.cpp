#include "interpolated_motion_driver/axis/cia402/position_limits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "interpolated_motion_driver/axis/cia402/sdo_steps.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"

namespace interpolated_motion::axis {

namespace object = cia402::object;

namespace {

constexpr double kRoom = 2.0;  // counts

}  // namespace

std::vector<canopen::SdoWrite> position_limits(const trajectory::JointLimits& limits,
                                               const encoding::Transmission& transmission,
                                               std::optional<double> present) {
  double low = std::numeric_limits<std::int32_t>::min();
  double high = std::numeric_limits<std::int32_t>::max();
  if (!limits.continuous && std::isfinite(limits.min_position) && std::isfinite(limits.max_position)) {
    const double from = present ? std::min(*present, limits.min_position) : limits.min_position;
    const double to = present ? std::max(*present, limits.max_position) : limits.max_position;
    const auto [a, b] = std::minmax({transmission.counts(from), transmission.counts(to)});
    low = std::floor(a) - kRoom;
    high = std::ceil(b) + kRoom;
  }
  return {canopen::sdo_write<std::int32_t>(object::kMinPositionLimit, sdo_steps::to_i32(low)),
          canopen::sdo_write<std::int32_t>(object::kMaxPositionLimit, sdo_steps::to_i32(high))};
}

}  // namespace interpolated_motion::axis
