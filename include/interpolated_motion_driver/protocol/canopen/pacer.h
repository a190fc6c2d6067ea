#pragma once

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::canopen {

/// Token bucket of frames: a burst of at most `burst` frames, then one frame per `interval` on average. Kept
/// as the time at which the bucket will be full again (exact in nanoseconds, so nothing drifts).
class Pacer {
 public:
  /// `interval` above 0, `burst` 1 or more.
  Pacer(HostDuration interval, int burst) : interval_(interval), reserve_(interval * (burst - 1)) {}

  /// From this time on the next frame may go.
  HostTime ready_time() const { return full_at_ - reserve_; }
  bool ready(HostTime now) const { return now >= ready_time(); }

  /// A frame went at `now`.
  void consume(HostTime now) { full_at_ = (full_at_ > now ? full_at_ : now) + interval_; }

 private:
  HostDuration interval_;
  HostDuration reserve_;
  HostTime full_at_{};
};

}  // namespace interpolated_motion::canopen
