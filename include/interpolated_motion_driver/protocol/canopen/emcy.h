#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

/// Emergency message (CiA 301, 7.2.7). Code 0x0000 tells that the error has been reset.
struct Emcy {
  std::uint16_t code = 0;                      ///< CiA 301, 7.2.7; from 0xFF00 on: of the device
  std::uint8_t error_register = 0;             ///< 0x1001 at that moment
  std::array<std::uint8_t, 5> manufacturer{};  ///< zeros on EPOS
  bool complete = true;                        ///< the frame had all 8 bytes
  HostTime time{};                             ///< of the frame's last bit
};

/// Decodes an emergency frame. Bytes missing from a short frame are zero (`complete` is false then); a data
/// length code above 8 counts as 8. Empty for a remote frame and for one too short to carry a code (under 2
/// bytes).
std::optional<Emcy> decode_emcy(const Frame& frame, HostTime time);

}  // namespace interpolated_motion::canopen
