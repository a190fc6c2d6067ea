#include "interpolated_motion_driver/encoding/ims/ims_encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace interpolated_motion::encoding {

namespace {

template <class Value>
void require(bool allowed, const std::string& joint, const char* parameter, Value value,
             const std::string& range) {
  if (allowed) return;
  throw std::invalid_argument(
      fmt::format("Joint '{}': {} is {}, allowed is {}.", joint, parameter, value, range));
}

bool finite_positive(double value) { return value > 0 && std::isfinite(value); }

void validate_transmission(const Transmission& transmission, const std::string& joint) {
  require(finite_positive(transmission.counts_per_revolution), joint, "counts_per_revolution",
          transmission.counts_per_revolution, "greater than 0");
  require(finite_positive(transmission.ratio), joint, "ratio", transmission.ratio, "greater than 0");
  require(transmission.direction == 1 || transmission.direction == -1, joint, "direction",
          transmission.direction, "1 or -1");
  require(std::isfinite(transmission.offset), joint, "offset", transmission.offset, "any finite number");
}

void validate_scale(const interpolation::ImsScale& scale, const std::string& joint) {
  try {
    scale.validate();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(fmt::format("Joint '{}': {}", joint, e.what()));
  }
}

}  // namespace

interpolation::ImsScale ImsEncoding::law() const {
  interpolation::ImsScale result = scale;
  result.counts_per_revolution = transmission.counts_per_revolution;
  return result;
}

void ImsEncoding::validate() const {
  validate_transmission(transmission, joint);
  validate_scale(law(), joint);
  require(finite_positive(bound_counts), joint, "bound_counts", bound_counts, "greater than 0");
  require(max_motor_rpm > 0, joint, "max_motor_rpm", max_motor_rpm, "greater than 0");
  require(max_motor_acceleration > 0, joint, "max_motor_acceleration", max_motor_acceleration,
          "greater than 0");
  require(max_segment_ticks >= 1 && max_segment_ticks <= kMaxImsSegmentTicks, joint, "max_segment_ticks",
          max_segment_ticks, fmt::format("1 to {}", kMaxImsSegmentTicks));
  require(min_segment_ticks >= 1 && min_segment_ticks <= max_segment_ticks, joint, "min_segment_ticks",
          min_segment_ticks, fmt::format("1 to max_segment_ticks, {}", max_segment_ticks));
}

double ImsStream::worst_deviation_counts() const {
  double worst = 0.0;
  for (const ImsCertificate& certificate : certificates) {
    worst = std::max(worst, certificate.worst_deviation_counts);
  }
  return worst;
}

}  // namespace interpolated_motion::encoding
