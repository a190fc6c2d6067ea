#pragma once

#include <cstdint>
#include <limits>

namespace interpolated_motion::encoding {

/// What the fields of an interpolation data record hold ("EPOS3 Interpolated Position Mode",
/// section 4.3.1.1).
inline constexpr std::int32_t kMinRecordPosition =
    std::numeric_limits<std::int32_t>::min();  ///< counts, signed 32 bit
inline constexpr std::int32_t kMaxRecordPosition = std::numeric_limits<std::int32_t>::max();  ///< counts
inline constexpr std::int32_t kMaxRecordVelocity =
    8388607;                                         ///< velocity units, signed 24 bit, used symmetrically
inline constexpr std::int64_t kMaxRecordTime = 255;  ///< ms; 1 is the least, as 0 ends the mode

/// Whether `counts`, or a velocity in the drive's `units`, has room in its field; false for a NaN.
inline bool fits_record_position(double counts) {
  return counts >= kMinRecordPosition && counts <= kMaxRecordPosition;
}
inline bool fits_record_velocity(double units) {
  return units >= -kMaxRecordVelocity && units <= kMaxRecordVelocity;
}

}  // namespace interpolated_motion::encoding
