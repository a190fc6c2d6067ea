#pragma once

#include <cstddef>
#include <deque>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Goal time as a function of the seconds a drive has played on its own clock: continuous, at a rate that may
/// change on the way, so that a path without end can stay with the host's clock on a drive whose crystal is
/// another.
class GoalTimeline {
 public:
  /// Begins anew: goal time `at_zero` when the drive sets out, one second per second from then on.
  void begin(GoalTime at_zero);
  /// From `drive_seconds` on, not before the last change, `rate` seconds of goal time pass in a second of the
  /// drive.
  void change_rate(double drive_seconds, double rate);

  /// Goal time when the drive has played `drive_seconds`; before the oldest change that is
  /// remembered, by the rate of that one.
  GoalTime at(double drive_seconds) const;

 private:
  struct Stretch {
    double drive_begin = 0.0;  ///< s, drive's clock
    GoalTime goal_begin{0.0};  ///< goal time at `drive_begin`
    double rate = 1.0;         ///< goal seconds per drive second, until the next stretch
  };
  /// Stretches remembered. Those of some seconds: what the drive reports is younger.
  static constexpr std::size_t kMemory = 512;

  std::deque<Stretch> stretches_{Stretch{}};
};

}  // namespace interpolated_motion::axis
