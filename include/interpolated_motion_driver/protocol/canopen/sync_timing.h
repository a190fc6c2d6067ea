#pragma once

#include <cstdint>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

/// How well periodic SYNC keeps its grid, as seen on the bus: a frame is late by the host's own delay, by the
/// frames before it, and by its own length.
class SyncTiming {
 public:
  /// A SYNC that was due at `due` has ended on the bus at `end`.
  void confirm(HostTime due, HostTime end);
  /// `count` SYNCs were not sent, since it was too late for them.
  void skip(std::uint64_t count) { skipped_ += count; }

  /// Mean delay of the last SYNCs (about `kMemory`), s; 0 before the first.
  double delay() const { return delay_; }
  /// Largest deviation of a delay from the mean in the last one to two seconds, s.
  double jitter() const { return before_ > worst_ ? before_ : worst_; }
  std::uint64_t skipped() const { return skipped_; }  ///< SYNCs not sent, see skip()

 private:
  static constexpr double kMemory = 16.0;

  std::uint64_t confirmed_ = 0;
  std::uint64_t skipped_ = 0;
  double delay_ = 0.0;
  double worst_ = 0.0;   ///< of the second that runs
  double before_ = 0.0;  ///< of the second before
  HostTime second_begin_{};
};

}  // namespace interpolated_motion::canopen
