#pragma once

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::interpolation {

/// Tag of CIP System Time: the clock a controller and its drives share, and in which commands are stamped. It
/// has no `now()`: whoever needs the time is given it.
struct CipSystemClock {
  using duration = HostDuration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<CipSystemClock>;
  static constexpr bool is_steady = false;  ///< System Time may be set while it runs
};

using SystemTime = CipSystemClock::time_point;

/// System Time Offset: how far System Time is ahead of the local clock.
struct SystemTimeOffset {
  HostDuration value{};  ///< positive when System Time is ahead

  /// The same instant on the other clock. No check of overflow.
  constexpr SystemTime system(HostTime local) const { return SystemTime(local.time_since_epoch() + value); }
  constexpr HostTime local(SystemTime system) const { return HostTime(system.time_since_epoch() - value); }
};

}  // namespace interpolated_motion::interpolation
