#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// The servo ticks of a drive (120 us) in true time: whole periods of its own crystal, without a rounding
/// that adds up.
class ServoClock {
 public:
  /// Tick 0 is at `start`, with the crystal's error of `parameters`.
  ServoClock(const SilverDustParameters& parameters, HostTime start);

  /// Counts from tick 0 again, which is at `start`.
  void restart(HostTime start);

  /// The crystal's error from the next tick on, ppm; > 0: fast.
  void set_error(double ppm);

  /// Ticks taken since the start.
  std::int64_t ticks() const { return ticks_; }

  /// When the last tick was, and when the next one is.
  HostTime last() const { return time_of(ticks_); }
  HostTime next() const { return time_of(ticks_ + 1); }

  /// The number that ticks() has at `now`, when all ticks until then are taken; 0 before the start.
  std::int64_t due(HostTime now) const;

  /// One tick is taken.
  void advance() { ++ticks_; }

  /// All ticks up to number `tick` are taken at once.
  void leap(std::int64_t tick) { ticks_ = tick; }

 private:
  HostTime time_of(std::int64_t tick) const;

  const HostDuration tick_;  // nominal
  HostTime start_;
  double period_ns_;
  std::int64_t ticks_ = 0;
};

}  // namespace interpolated_motion::emulation
