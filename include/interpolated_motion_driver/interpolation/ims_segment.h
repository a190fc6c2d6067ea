#pragma once

#include <cstdint>

namespace interpolated_motion {

/// A velocity segment of QuickSilver's interpolated motion ("Interpolated Motion", QCI-TD044), as the four
/// numbers of the IMW command and of the register-based queue, in their order there.
struct ImsSegment {
  std::int32_t time = 0;  ///< servo ticks until the next segment, 1..2^31-1; 0 ends the interpolated motion
  std::int32_t position =
      0;  ///< counts: direction of the motion, or where a segment that comes to a halt ends
  std::int32_t acceleration =
      0;                      ///< 0..2^30 (2^31 is the full scale of the acceleration); 0: constant velocity
  std::int32_t velocity = 0;  ///< 0..2^31-1 (2^31 is the full scale of the velocity), a magnitude
};

/// Exact: the four whole numbers.
inline bool operator==(const ImsSegment& a, const ImsSegment& b) {
  return a.time == b.time && a.position == b.position && a.acceleration == b.acceleration &&
         a.velocity == b.velocity;
}
inline bool operator!=(const ImsSegment& a, const ImsSegment& b) { return !(a == b); }

}  // namespace interpolated_motion
