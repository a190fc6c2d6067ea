#include "interpolated_motion_driver/axis/cia402/value_origin.h"

#include <fmt/format.h>

namespace interpolated_motion::axis {

std::string origin_of(const AxisParameters& parameters, const char* key, double value) {
  return fmt::format("drives/{}/{} ({})", parameters.joint, key, value);
}

std::string position_limits_origin(const AxisParameters& parameters) {
  return origin_of(parameters, "limits/min_position", parameters.limits.min_position) + " and " +
         fmt::format("max_position ({})", parameters.limits.max_position);
}

}  // namespace interpolated_motion::axis
