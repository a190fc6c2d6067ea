#pragma once

#include <cstdint>

namespace interpolated_motion {

/// An interpolation data record of maxon's Interpolated Position Mode (object 0x20C1; "EPOS3 Interpolated
/// Position Mode", section 4.3.1.1), as numbers. The drive reaches `position` with `velocity`, `time` after
/// the record before it.
struct PvtRecord {
  std::int32_t position = 0;  ///< absolute, in position units (quadcounts, qc)
  std::int32_t velocity =
      0;  ///< of the motor, in the drive's velocity unit (0x608B); 24 bits on the wire: +-8388607
  std::uint8_t time = 0;  ///< ms, 1..255; 0 ends the mode without an error
};

/// Exact: the three whole numbers.
inline bool operator==(const PvtRecord& a, const PvtRecord& b) {
  return a.position == b.position && a.velocity == b.velocity && a.time == b.time;
}
inline bool operator!=(const PvtRecord& a, const PvtRecord& b) { return !(a == b); }

}  // namespace interpolated_motion
