#pragma once

#include <algorithm>
#include <chrono>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

/// The wall clock, by which the kernel stamps frames, against the host clock. Neither can be read at the
/// instant of the other: between two readings the program may be put off by other programs, for milliseconds
/// on a busy machine, and stamps would be wrong by that. So the wall clock is read between two readings of
/// the host clock, which bound the difference; what is known already is kept as long as it is within the
/// bounds.
class WallClockOffset {
 public:
  /// `wall` was read after `before` and before `after`.
  void measure(HostTime before, HostDuration wall, HostTime after) {
    const HostDuration least = wall - after.time_since_epoch();
    const HostDuration most = wall - before.time_since_epoch();
    offset_ = known_ ? std::clamp(offset_, least, most) : least + (most - least) / 2;
    known_ = true;
    now_ = after;
  }

  /// The host time of a stamp taken before the last measurement. A stamp that seems to be of the future, or
  /// older than a minute, is not believed, since the wall clock was set meanwhile: it counts as taken now.
  HostTime host_time_of(HostDuration wall_stamp) const {
    constexpr HostDuration kOldest = std::chrono::seconds(60);
    const HostTime time(wall_stamp - offset_);
    return time <= now_ && now_ - time < kOldest ? time : now_;
  }

 private:
  bool known_ = false;
  HostDuration offset_{};  ///< wall clock minus host clock
  HostTime now_{};         ///< of the last measurement
};

}  // namespace interpolated_motion::transport
