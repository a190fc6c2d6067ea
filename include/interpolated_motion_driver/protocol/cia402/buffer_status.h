#pragma once

#include <cstdint>
#include <string>

namespace interpolated_motion::cia402 {

/// Interpolation buffer status, object 0x20C4:01 ("EPOS3 Interpolated Position Mode", tables 4-34 and 4-35).
struct BufferStatus {
  std::uint16_t raw = 0;  ///< as it is on the wire

  static constexpr std::uint16_t kWarnings = 0x000F;  ///< bits 0..3
  static constexpr std::uint16_t kErrors = 0x0F00;    ///< bits 8..11

  /// Bit `n`, 0..15; the bits with a name below.
  bool bit(unsigned n) const { return (raw >> n & 1u) != 0; }
  bool underflow_warning() const { return bit(0); }     ///< fill below 0x20C4:02
  bool overflow_warning() const { return bit(1); }      ///< fill above 0x20C4:03
  bool velocity_warning() const { return bit(2); }      ///< above profile velocity, 0x6081
  bool acceleration_warning() const { return bit(3); }  ///< above profile acceleration, 0x6083
  bool underflow_error() const { return bit(8); }       ///< ran dry before a record of time 0
  bool overflow_error() const { return bit(9); }        ///< a record came when it was full
  bool velocity_error() const { return bit(10); }       ///< above maximal profile velocity, 0x607F
  bool acceleration_error() const { return bit(11); }   ///< above maximal acceleration, 0x60C5
  bool enabled() const { return bit(14); }              ///< the drive takes records
  bool ip_mode_active() const { return bit(15); }       ///< the drive plays them; equals statusword bit 12

  /// Any bit of kWarnings, of kErrors.
  bool any_warning() const { return (raw & kWarnings) != 0; }
  bool any_error() const { return (raw & kErrors) != 0; }

  /// "underflow error, buffer enabled (0x4100)".
  std::string text() const;
};

}  // namespace interpolated_motion::cia402
