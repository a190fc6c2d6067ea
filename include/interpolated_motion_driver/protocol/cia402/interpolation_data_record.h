#pragma once

#include <array>
#include <cstdint>

namespace interpolated_motion::cia402 {

/// Interpolation data record, object 0x20C1 ("EPOS3 Interpolated Position Mode", section 4.3.1.1), as it is
/// on the wire:
///
/// | bytes | field    | type             | unit                                         |
/// |-------|----------|------------------|----------------------------------------------|
/// | 0..3  | position | s32, LSB first   | position unit, qc                            |
/// | 4..6  | velocity | s24, LSB first   | velocity unit (0x608B), rpm of the motor     |
/// | 7     | time     | u8               | ms, 1..255; 0 ends the mode without an error |
struct InterpolationDataRecord {
  std::int32_t position = 0;  ///< qc, absolute
  std::int32_t velocity = 0;  ///< kMinRecordVelocity..kMaxRecordVelocity, signed as the position
  std::uint8_t time = 0;      ///< ms since the record before
};

inline bool operator==(const InterpolationDataRecord& a, const InterpolationDataRecord& b) {
  return a.position == b.position && a.velocity == b.velocity && a.time == b.time;
}

/// Range of the velocity field, both ends included.
inline constexpr std::int32_t kMinRecordVelocity = -8388608;
inline constexpr std::int32_t kMaxRecordVelocity = 8388607;

/// Whether a velocity fits into the 24 bits of the record.
inline constexpr bool fits_record_velocity(std::int64_t velocity) {
  return velocity >= kMinRecordVelocity && velocity <= kMaxRecordVelocity;
}

/// The 8 bytes of a record. A velocity that does not fit is sent modulo 2^24: check with
/// `fits_record_velocity` before.
std::array<std::uint8_t, 8> pack(const InterpolationDataRecord& record);

/// The record in 8 bytes.
InterpolationDataRecord unpack_record(const std::uint8_t* bytes);

}  // namespace interpolated_motion::cia402
