#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"
#include "interpolated_motion_driver/encoding/record_range.h"

namespace interpolated_motion::encoding {

namespace {

template <class Value>
void require(bool allowed, const std::string& joint, const char* parameter, Value value,
             const std::string& range) {
  if (allowed) return;
  throw std::invalid_argument(
      fmt::format("Joint '{}': {} is {}, allowed is {}.", joint, parameter, value, range));
}

bool positive(double value) { return value > 0; }
bool finite_positive(double value) { return value > 0 && std::isfinite(value); }

bool known_unit(double rpm) {
  for (const double unit : {1.0, 0.1, 0.01, 0.001}) {
    if (std::abs(rpm - unit) <= 1e-9 * unit) return true;
  }
  return false;
}

void validate_transmission(const Transmission& transmission, const std::string& joint) {
  require(finite_positive(transmission.counts_per_revolution), joint, "counts_per_revolution",
          transmission.counts_per_revolution, "greater than 0");
  require(finite_positive(transmission.ratio), joint, "ratio", transmission.ratio, "greater than 0");
  require(transmission.direction == 1 || transmission.direction == -1, joint, "direction",
          transmission.direction, "1 or -1");
  require(std::isfinite(transmission.offset), joint, "offset", transmission.offset, "any finite number");
}

}  // namespace

void PvtEncoding::validate() const {
  validate_transmission(transmission, joint);
  require(known_unit(velocity_unit_rpm), joint, "velocity_unit_rpm", velocity_unit_rpm,
          "1, 0.1, 0.01 or 0.001");
  require(finite_positive(bound_counts), joint, "bound_counts", bound_counts, "greater than 0");
  require(positive(max_motor_rpm), joint, "max_motor_rpm", max_motor_rpm, "greater than 0");
  require(positive(max_motor_acceleration), joint, "max_motor_acceleration", max_motor_acceleration,
          "greater than 0");
  require(max_record_ms >= 1 && max_record_ms <= kMaxRecordTime, joint, "max_record_ms", max_record_ms,
          fmt::format("1 to {}", kMaxRecordTime));
}

}  // namespace interpolated_motion::encoding
