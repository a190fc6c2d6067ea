#pragma once

#include <array>
#include <cstdint>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

/// A classic CAN data or remote frame (ISO 11898-1), as it stands on the bus.
struct Frame {
  std::uint32_t id = 0;                ///< 11-bit identifier, or 29-bit when `extended`
  bool extended = false;               ///< 29-bit identifier
  bool remote = false;                 ///< remote transmission request: carries a length but no data
  std::uint8_t length = 0;             ///< data length code, 0..8
  std::array<std::uint8_t, 8> data{};  ///< the first `length` bytes; zeros behind them
};

/// The same on the bus; the bytes behind `length` are compared too, so leave them 0.
inline bool operator==(const Frame& a, const Frame& b) {
  return a.id == b.id && a.extended == b.extended && a.remote == b.remote && a.length == b.length &&
         a.data == b.data;
}
inline bool operator!=(const Frame& a, const Frame& b) { return !(a == b); }

/// A frame seen on the bus: the time of its last bit, and whether this host sent it.
struct ReceivedFrame {
  Frame frame;       ///< as it was on the bus
  HostTime time{};   ///< of its last bit on the bus
  bool own = false;  ///< confirmation that a frame of this host has been on the bus
};

}  // namespace interpolated_motion::canopen
