#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

struct LineParameters {
  std::uint32_t baud = 57'600;  ///< bit/s, 300..250000
  int bits_per_character = 11;  ///< 10..12: start, 8 data, 2 stop bits are 11
  /// From the last bit of a request to the first of its reply as drives normally take, 0..1 s. For planning.
  HostDuration turnaround = std::chrono::milliseconds(2);
  /// The same at most, `turnaround`..10 s: a reply that begins later is lost. Raise it when ADL delays the
  /// replies.
  HostDuration reply_timeout = std::chrono::milliseconds(20);
  /// Silence before the next request once a reply was lost or garbled, or after a request that is not
  /// answered, 0..10 s. An ACK tells no command: one that comes later than `reply_timeout` + `guard` would be
  /// taken for the answer to the next request.
  HostDuration guard = std::chrono::milliseconds(10);
  /// Silence between a reply and the next request, 0..1 s, for drives that let go of a two-wire line late.
  HostDuration pause = HostDuration::zero();
  int repeats = 3;  ///< of a request that got no whole reply and may be repeated, 0..100
  std::size_t request_capacity =
      32;  ///< requests of each device waiting or with their outcome not taken, 2..4096
};

/// Throws std::invalid_argument with line, parameter, value and range.
void check(const std::string& line_name, const LineParameters& parameters);

}  // namespace interpolated_motion::silverlode
