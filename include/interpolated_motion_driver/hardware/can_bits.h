#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/bus_load.h"
#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::hardware {

/// Bits that a frame with an 11-bit identifier and `bytes` of data, 0..8, takes of a bus at most.
inline double longest_frame_bits(int bytes) {
  canopen::Frame frame;
  frame.length = static_cast<std::uint8_t>(bytes);
  return canopen::worst_case_bits(frame);
}

}  // namespace interpolated_motion::hardware
