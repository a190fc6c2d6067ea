#pragma once

#include <cmath>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// The crystal of a drive: counts nanoseconds of its own, as many as its error makes of true time.
class Crystal {
 public:
  /// `ppm` > 0: fast. Counts from 0 at `start`.
  Crystal(double ppm, HostTime start) : start_(start) { set_error(ppm, start); }

  /// Counts from 0 again at `start`, with the same error.
  void restart(HostTime start) {
    start_ = start;
    count_at_start_ = 0.0;
  }

  /// From `now` on the error is `ppm`; the count goes on without a jump.
  void set_error(double ppm, HostTime now) {
    count_at_start_ = count(now);
    start_ = now;
    length_ = 1.0 / (1.0 + ppm * 1e-6);
  }

  /// Own nanoseconds counted at true time `when`.
  double count(HostTime when) const {
    return count_at_start_ + static_cast<double>((when - start_).count()) / length_;
  }

  /// True time at which `count` own nanoseconds have been counted.
  HostTime time_of(double count) const {
    return start_ + HostDuration(std::llround((count - count_at_start_) * length_));
  }

 private:
  HostTime start_;
  double count_at_start_ = 0.0;
  double length_ = 1.0;  ///< true length of an own nanosecond, ns
};

}  // namespace interpolated_motion::emulation
