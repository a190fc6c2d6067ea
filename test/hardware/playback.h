#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hardware/scenario.h"

namespace interpolated_motion::test {

inline constexpr double kPi = 3.14159265358979324;

/// 0.2 rad (1 - cos(pi t)) on every joint: a period of 2 s, from rest to rest in a whole number of them.
inline double sine_position(double t) { return 0.2 * (1.0 - std::cos(kPi * t)); }
inline constexpr double kSineSpeed = 0.2 * kPi;  ///< rad/s, highest

/// That sine with a point each 0.1 s; odd joints go the other way.
inline trajectory::Goal sine_goal(int joints, double seconds) {
  std::vector<double> times;
  std::vector<std::vector<double>> positions;
  std::vector<std::vector<double>> velocities;
  const int last = static_cast<int>(std::lround(10.0 * seconds));
  for (int i = 0; i <= last; ++i) {
    const double t = 0.1 * i;
    times.push_back(t);
    positions.emplace_back();
    velocities.emplace_back();
    for (int joint = 0; joint < joints; ++joint) {
      const double sign = joint % 2 == 0 ? 1.0 : -1.0;
      positions.back().push_back(sign * sine_position(t));
      velocities.back().push_back(i == last ? 0.0 : sign * kSineSpeed * std::sin(kPi * t));
    }
  }
  return make_goal(times, positions, velocities);
}

/// How far emulated drives have played, by their own samples and true time: nothing of the driver's estimate.
class Playback {
 public:
  struct Drive {
    HostTime started{};  ///< of the sample that made the interpolation active
    HostTime time{};     ///< of the last sample that interpolated
    std::int64_t samples = -1;
  };

  Playback(Scenario& scenario, std::size_t joints) : drives_(joints) {
    scenario.driver().set_sample_observer([this](std::size_t joint, const hardware::DemandSample& sample) {
      Drive& drive = drives_[joint];
      const auto samples = std::lround(1e3 * sample.drive_seconds);
      if (samples == 0) drive.started = sample.time;
      drive.time = sample.time;
      drive.samples = samples;
    });
  }

  const std::vector<Drive>& drives() const { return drives_; }

  /// Whether every drive has started; what follows is meant from then on.
  bool all_started() const {
    return std::all_of(drives_.begin(), drives_.end(), [](const Drive& drive) { return drive.samples >= 0; });
  }

  /// Playing time of `joint` at `when`, s.
  double played(std::size_t joint, HostTime when) const {
    const Drive& drive = drives_[joint];
    return 1e-3 * static_cast<double>(drive.samples) + seconds(when - drive.time);
  }

  /// By how much the drive has played more than true time since its start, s.
  double gained(std::size_t joint) const {
    const Drive& drive = drives_[joint];
    return 1e-3 * static_cast<double>(drive.samples) - seconds(drive.time - drive.started);
  }

  /// From the drive that is least to the one that is most advanced at `when`, s.
  double spread(HostTime when) const {
    double least = played(0, when);
    double most = least;
    for (std::size_t i = 1; i < drives_.size(); ++i) {
      least = std::min(least, played(i, when));
      most = std::max(most, played(i, when));
    }
    return most - least;
  }

 private:
  std::vector<Drive> drives_;
};

}  // namespace interpolated_motion::test
