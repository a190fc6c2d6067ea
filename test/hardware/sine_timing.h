#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "hardware/playback.h"
#include "hardware/scenario.h"

namespace interpolated_motion::test {

/// How far emulated drives of any kind have got in the sine goal, read off the positions they demand: neither
/// the driver's estimate of their clocks nor its records have a part in it. A drive at rest at 0 rad, with
/// `counts_per_radian`, is meant.
///
/// Only where the sine is steep does its position tell the time: half a count is 50 us there, and less.
class SineTiming {
 public:
  SineTiming(Scenario& scenario, std::size_t joints, double counts_per_radian)
      : counts_per_radian_(counts_per_radian), drives_(joints) {
    scenario.driver().set_sample_observer(
        [this](std::size_t joint, const hardware::DemandSample& sample) { take(joint, sample); });
  }

  /// From the drive that is least to the one that is most advanced, s; empty until all have got to the first
  /// steep part.
  std::optional<double> spread() const {
    double least = 1e300;
    double most = -1e300;
    for (const Drive& drive : drives_) {
      if (!drive.ahead) return std::nullopt;
      least = std::min(least, *drive.ahead);
      most = std::max(most, *drive.ahead);
    }
    return most - least;
  }
  /// By how much the drive has got further since the first steep part than true time, s.
  double gained(std::size_t joint) const {
    const Drive& drive = drives_[joint];
    return drive.ahead.value_or(0.0) - drive.ahead_at_first.value_or(0.0);
  }
  /// Largest spread since the start, s.
  double worst_spread() const { return worst_; }
  std::uint64_t looks() const { return looks_; }

 private:
  struct Drive {
    double position = 0.0;  ///< rad, of the last sample; of a sine that begins upwards
    bool was_falling = false;
    int periods = 0;              ///< complete ones
    std::optional<double> ahead;  ///< s: time along the sine less true time
    std::optional<double> ahead_at_first;
  };

  void take(std::size_t joint, const hardware::DemandSample& sample) {
    Drive& drive = drives_[joint];
    const double sign = joint % 2 == 0 ? 1.0 : -1.0;
    const double position = sign * sample.demand / counts_per_radian_;
    const bool rising = position > std::exchange(drive.position, position);
    const double cosine = 1.0 - position / 0.2;
    if (std::abs(cosine) > kSteep) return;
    if (rising && std::exchange(drive.was_falling, false)) ++drive.periods;
    if (!rising) drive.was_falling = true;
    const double phase = std::acos(cosine) / kPi;
    const double along = 2.0 * drive.periods + (rising ? phase : 2.0 - phase);
    drive.ahead = along - seconds(sample.time.time_since_epoch());
    if (!drive.ahead_at_first) drive.ahead_at_first = drive.ahead;
    if (const auto apart = spread()) {
      worst_ = std::max(worst_, *apart);
      ++looks_;
    }
  }

  /// |cos| up to here: at least half of the highest speed.
  static constexpr double kSteep = 0.866;

  double counts_per_radian_;
  std::vector<Drive> drives_;
  double worst_ = 0.0;
  std::uint64_t looks_ = 0;
};

}  // namespace interpolated_motion::test
