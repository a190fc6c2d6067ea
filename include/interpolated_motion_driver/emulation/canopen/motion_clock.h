#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/crystal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

struct MotionClockSettings {
  double error_ppm = 0.0;                                     ///< of the crystal, > 0: fast
  HostDuration sample_period = std::chrono::milliseconds(1);  ///< nominal
  bool discipline = false;                                    ///< the clock follows SYNC and time stamps
  HostDuration slew =
      std::chrono::microseconds(1);  ///< most by which a sample is made shorter or longer for that
};

/// The clock that makes a drive's samples, and its discipline by the master ("EPOS2 Interpolated
/// Position Mode", 2008: SYNC and High Resolution Time Stamp): the drive latches the clock at SYNC, the
/// master sends the time of that SYNC in 0x1013, and the drive corrects its clock by the difference.
///
/// How is not documented. Here the first time stamp sets the reference, so that only what both clocks do from
/// then on counts; a difference is made up at the samples, each shorter or longer by at most `slew`; a
/// latched value serves for one time stamp, so a time stamp whose SYNC did not arrive is ignored.
class MotionClock {
 public:
  /// The first sample comes at `now`; see restart().
  MotionClock(const MotionClockSettings& settings, HostTime now);

  /// Power-up: the first sample comes at `first`.
  void restart(HostTime first);
  /// The crystal's error from the next sample on, ppm.
  void set_error(double ppm) { crystal_.set_error(ppm, next_sample_); }

  /// Samples taken since power-up.
  std::int64_t samples() const { return samples_; }
  /// Whole milliseconds of the nominal period in them.
  std::int64_t milliseconds() const {
    return samples_ * settings_.sample_period / std::chrono::milliseconds(1);
  }
  /// The samples with their fraction between two of them: at each sample the number of it, the first being 1.
  double samples_at(HostTime when) const;

  /// When the next sample is due.
  HostTime next_sample() const { return next_sample_; }
  /// The sample has come: makes up for a part of the difference and goes on to the next one.
  void take_sample();

  /// The next time stamp sets the reference.
  void forget_reference();
  /// TIME at `when`: the clock reads 0, and the next time stamp is held against that.
  void start_over(HostTime when);
  /// SYNC at `when`.
  void latch(HostTime when);
  /// 0x1013 has been written: the time of the last SYNC on the master's clock, us, modulo 2^32.
  void take_time_stamp(std::uint32_t microseconds);

 private:
  std::uint32_t latched_microseconds() const;
  void schedule();

  const MotionClockSettings settings_;
  const double period_;  // ns
  Crystal crystal_;
  HostTime next_sample_;
  std::int64_t samples_ = 0;  ///< taken since power-up

  // The motion clock is the count of the crystal plus the correction made so far plus the reference, ns.
  double correction_ = 0.0;
  double wanted_correction_ = 0.0;
  double reference_ = 0.0;
  bool has_reference_ = false;

  bool latched_ = false;
  double latched_count_ = 0.0;
  double latched_correction_ = 0.0;
};

}  // namespace interpolated_motion::emulation
