#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "interpolated_motion_driver/emulation/silverdust/parameters.h"

namespace interpolated_motion::emulation {

/// The limits of the position error, one for an axis in motion and one for an axis at rest, which counts only
/// some time after the motion has ended (Command Reference, ERL).
class ErrorLimits {
 public:
  /// Which limit has been exceeded.
  enum class Excess { None, Moving, Holding };

  /// `parameters`, which must outlive it, say what the limits are until ERL sets them.
  explicit ErrorLimits(const SilverDustParameters& parameters) : delivered_(parameters) { restart(); }

  /// As after power-up: the limits of the parameters, at rest, no error yet.
  void restart();

  /// ERL: `moving` and `holding` in counts, 1..32767; `delay` in ticks, 0..65535, from the next motion's end
  /// on.
  void set(int moving, int holding, int delay);

  /// A motion is over: the holding limit counts after the delay.
  void begin_holding() { countdown_ = delay_; }

  /// One servo tick at rest.
  void hold() {
    if (countdown_ > 0) --countdown_;
  }

  /// The delay is running.
  bool waiting() const { return countdown_ > 0; }

  /// Takes the position error of a tick, counts, into account for largest().
  void record(std::int64_t error) { largest_ = std::max(largest_, std::abs(error)); }

  /// The largest magnitude since power-up, counts.
  std::int64_t largest() const { return largest_; }

  /// Whether `error`, counts, is too large for an axis that is `moving` or at rest.
  Excess exceeded(std::int64_t error, bool moving) const {
    const std::int64_t size = std::abs(error);
    if (moving) return size > moving_ ? Excess::Moving : Excess::None;
    return countdown_ == 0 && size > holding_ ? Excess::Holding : Excess::None;
  }

 private:
  const SilverDustParameters& delivered_;
  int moving_ = 0;
  int holding_ = 0;
  int delay_ = 0;
  int countdown_ = 0;
  std::int64_t largest_ = 0;
};

}  // namespace interpolated_motion::emulation
