#pragma once

#include <cstdint>
#include <initializer_list>
#include <ostream>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/frame_text.h"

namespace interpolated_motion::canopen {

inline void PrintTo(const Frame& frame, std::ostream* out) { *out << to_string(frame); }

namespace test {

/// A frame from its identifier and data bytes.
inline Frame make_frame(std::uint32_t id, std::initializer_list<int> bytes) {
  Frame frame;
  frame.id = id;
  for (int byte : bytes) frame.data[frame.length++] = static_cast<std::uint8_t>(byte);
  return frame;
}

inline constexpr HostTime at_us(std::int64_t us) { return HostTime(std::chrono::microseconds(us)); }
inline constexpr HostTime at_ms(std::int64_t ms) { return HostTime(std::chrono::milliseconds(ms)); }

}  // namespace test
}  // namespace interpolated_motion::canopen
