#pragma once

#include <chrono>
#include <cstdint>
#include <ratio>

/// The kinds of time in the driver. Each has its own type, so they mix only through a named conversion:
///
/// | type                | clock                                  | used for                        |
/// |---------------------|----------------------------------------|---------------------------------|
/// | `HostTime`          | the host's monotonic clock             | the host, time stamps of buses  |
/// | `GoalTime`          | start of a trajectory = 0              | paths, tolerances, knots        |
/// | `DriveMilliseconds` | samples of one EPOS drive, own crystal | PVT records, 1..255 ms each     |
/// | `ServoTicks`        | ticks of one SilverLode, own crystal   | IMS segments                    |
///
/// ROS time exists in `node/` only. The host clock is never read below `transport/` and `node/`: time is a
/// parameter.
namespace interpolated_motion {

/// Tag of the host's monotonic clock. It has no `now()`: whoever needs the time is given it.
struct HostClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<HostClock>;
  static constexpr bool is_steady = true;  ///< the host's clock never goes back and is never set
};

using HostDuration = HostClock::duration;
using HostTime = HostClock::time_point;

/// A deadline that never comes.
inline constexpr HostTime kNever = HostTime::max();

/// Seconds since the start of a trajectory.
using GoalTime = std::chrono::duration<double>;

/// Interpolator samples of an EPOS drive, on that drive's own crystal.
using DriveMilliseconds = std::chrono::duration<std::int64_t, std::milli>;

/// Servo ticks of a SilverLode drive, on that drive's own crystal: 120 us nominally (QCI-TD044).
using ServoTicks = std::chrono::duration<std::int64_t, std::ratio<3, 25000>>;

/// Length of a host duration in seconds.
inline constexpr double seconds(HostDuration d) { return std::chrono::duration<double>(d).count(); }

/// Host duration nearest to `s` seconds. `s` must be within +-292 years.
inline constexpr HostDuration host_duration(double s) {
  return HostDuration(static_cast<HostDuration::rep>(s * 1e9 + (s < 0 ? -0.5 : 0.5)));
}

}  // namespace interpolated_motion
