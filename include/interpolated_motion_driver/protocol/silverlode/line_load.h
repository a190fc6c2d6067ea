#pragma once

#include <array>
#include <cstdint>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::silverlode {

/// Share of the time in which a line is taken by exchanges (request, turnaround and reply, or the time-out),
/// over the last second in steps of 100 ms. A half-duplex line that waits for a reply is not free, so 1 is
/// saturation.
class LineLoad {
 public:
  /// The line was taken from `begin` to `end`. Intervals must not overlap; only the last second of one
  /// counts.
  void add(HostTime begin, HostTime end);

  /// 0..1, of the last 0.9 to 1 s. During the first second the time before counts as idle.
  double load(HostTime now) const;

 private:
  static constexpr int kSlots = 10;
  static constexpr HostDuration kSlot = std::chrono::milliseconds(100);
  struct Slot {
    std::int64_t number = -1;  ///< time in 100 ms since the epoch; -1: nothing yet
    HostDuration taken{};      ///< of these 100 ms
  };

  void add_to_slot(std::int64_t number, HostDuration taken);

  std::array<Slot, kSlots> slots_{};
};

}  // namespace interpolated_motion::silverlode
