#pragma once

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Estimates how far a drive has played its plan: the drive's own elapsed time as a function of host time.
///
/// The start is known (the start signal on the bus, to within one sample of the drive), the drive's crystal
/// is not: its rate lies within +-`max_error` of the host's. Each look at the drive's FIFO says "by then it
/// had played at least this much" or "not yet that much"; both bound the rate, and the estimate is a rate
/// within the bounds, see Estimate. So the error of the estimate never exceeds the interval between two looks
/// at the FIFO, however long the motion.
///
/// A drive that sets its clock by the host's plays at the host's rate: then the estimate is host time, and
/// what remains is a deviation of at most `kFollowing`, however long the motion. What the FIFO says still
/// bounds the rate of the crystal, for the case that the drive stops following.
class PlaybackClock {
 public:
  /// Which of the rates within the bounds is taken.
  enum class Estimate {
    NearestToHost,  ///< the looks are rare: as long as nothing speaks against it, the crystals agree
    Middle,         ///< each look bounds the clock closely, from both sides alike
  };

  /// Largest relative error of a drive's crystal, if nothing else is said: five times that of a common one.
  static constexpr double kMaxError = 5e-4;

  /// `max_error`: largest relative error of a drive's crystal. `sample`: uncertainty of the start, s.
  explicit PlaybackClock(double max_error = kMaxError, double sample = 1e-3,
                         Estimate estimate = Estimate::NearestToHost);

  /// Largest deviation of a drive that follows the host, s: start and report are each known to a sample, and
  /// the rest is for a drive that latches its report late and for time stamps lost on the way.
  static constexpr double kFollowing = 3e-3;

  /// `follows_host`: the drive sets its clock by the host's.
  void start(HostTime start, bool follows_host = false);
  bool follows_host() const { return follows_host_; }
  /// The drive has turned out not to follow: from now on the estimate is by what has been observed.
  void stop_following() { follows_host_ = false; }
  bool running() const { return running_; }
  /// Nothing is played any more: elapsed() is 0 until the next start().
  void stop() { running_ = false; }
  HostTime start_time() const { return start_; }

  /// Seconds of drive time played at host time `when`; 0 before the start.
  double elapsed(HostTime when) const;
  /// The least and the most the drive can have played at `when`, by all that has been observed.
  double least_elapsed(HostTime when) const;
  double most_elapsed(HostTime when) const;
  /// Host time at which the drive will have played `drive_seconds`.
  HostTime host_time(double drive_seconds) const;

  /// At `when` the drive had played at least `drive_seconds`.
  void observe_at_least(HostTime when, double drive_seconds);
  /// At `when` the drive had not yet played `drive_seconds`.
  void observe_less_than(HostTime when, double drive_seconds);

  /// Seconds of the plan to write per second of the drive from now on, for a drive that is `behind` (s;
  /// negative: ahead) where it should be: its own rate is made good, and what it is behind within two
  /// seconds. Differs from 1 by at most twice `max_error`; is 1 for a drive that follows the host.
  double goal_rate(double behind) const;

  /// Estimated error of the drive's clock against the host's, ppm, by the motion under way or the last one; 0
  /// where it follows the host, NaN as long as nothing has been observed.
  double error_ppm() const;

 private:
  double rate() const;

  double max_error_;
  double sample_;
  Estimate estimate_;
  bool running_ = false;
  bool follows_host_ = false;
  HostTime start_{};
  double lowest_rate_;
  double highest_rate_;
};

}  // namespace interpolated_motion::axis
