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
  /// `count` (>= 1) SYNCs, `period` apart and the first of them due at `first`, are not sent, since it is too
  /// late for them.
  void leave_out(HostTime first, HostDuration period, std::uint64_t count = 1);
  /// When the first and the last one of the last row that was left out were due. Before there is one, the
  /// latest and the earliest time there is: nothing lies between.
  HostTime first_left_out() const { return first_left_out_; }
  HostTime last_left_out() const { return last_left_out_; }

  /// Mean delay of the last SYNCs (about `kMemory`), s; 0 before the first.
  double delay() const { return delay_; }
  /// Largest deviation of a delay from the mean in the last one to two seconds, s.
  double jitter() const { return before_ > worst_ ? before_ : worst_; }
  std::uint64_t skipped() const { return skipped_; }  ///< SYNCs not sent, see leave_out()

 private:
  static constexpr double kMemory = 16.0;

  std::uint64_t confirmed_ = 0;
  std::uint64_t skipped_ = 0;
  HostTime first_left_out_ = kNever;
  HostTime last_left_out_ = HostTime::min();
  double delay_ = 0.0;
  double worst_ = 0.0;   ///< of the second that runs
  double before_ = 0.0;  ///< of the second before
  HostTime second_begin_{};
};

}  // namespace interpolated_motion::canopen
