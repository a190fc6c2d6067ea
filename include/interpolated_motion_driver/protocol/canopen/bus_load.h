#pragma once

#include <array>
#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

/// Bits of a frame on the bus, with the 3 bits of pause behind it and the most stuff bits it can have (Davis
/// et al., "Controller Area Network schedulability analysis"): 135 for 8 data bytes with an 11-bit
/// identifier.
unsigned worst_case_bits(const Frame& frame);

/// Bits a frame has on average: without stuffing, plus one stuff bit in 13 of the bits subject to stuffing.
/// That is 118.5 for 8 bytes; a bit-exact builder gives a mean of 118.3 over a sine of PVT records.
double average_bits(const Frame& frame);

/// Share of the bus in use, measured over the last second in steps of 100 ms.
class BusLoad {
 public:
  /// `bitrate` in bit/s, above 0.
  explicit BusLoad(std::uint32_t bitrate) : bitrate_(bitrate) {}

  /// A frame ended at `time`. Times may go back a little, as frames of several sources are merged.
  void add(const Frame& frame, HostTime time);

  /// 0..1 (a little above 1 is possible, since stuff bits are estimated): frames of the last 0.9 to 1 s.
  /// During the first second, bits not seen count as idle.
  double load(HostTime now) const;

 private:
  static constexpr int kSlots = 10;
  static constexpr HostDuration kSlot = std::chrono::milliseconds(100);
  struct Slot {
    std::int64_t number = -1;  ///< time in 100 ms since the epoch; -1: nothing yet
    double bits = 0;           ///< of the frames that ended in it, average_bits() of each
  };

  std::uint32_t bitrate_;
  std::array<Slot, kSlots> slots_{};
};

}  // namespace interpolated_motion::canopen
