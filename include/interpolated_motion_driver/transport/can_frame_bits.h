#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::transport {

/// CRC-15 of a frame as ISO 11898-1 computes it (polynomial 0x4599) from the start of frame to the last data
/// bit.
std::uint16_t can_crc15(const canopen::Frame& frame);

/// Number of bit times a frame occupies on the bus: start of frame, arbitration and control field, data and
/// CRC with their stuff bits, CRC delimiter, acknowledge slot and delimiter, end of frame, and the 3 bits of
/// interframe space. 55 .. 65 for an empty standard frame, 111 .. 135 for one with 8 bytes.
int can_frame_bits(const canopen::Frame& frame);

}  // namespace interpolated_motion::transport
