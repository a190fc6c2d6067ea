#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::axis {

inline constexpr double kCounts = 1000.0;  // per rad
inline constexpr double kMaxAcceleration = 10.0;

inline encoding::SetpointEncoding encoding_of(double counts) {
  encoding::SetpointEncoding encoding;
  encoding.transmission.counts_per_revolution = counts * 2.0 * 3.14159265358979324;
  return encoding;
}

inline HostTime at(int ms) { return HostTime{std::chrono::milliseconds(ms)}; }

/// From `from` at constant `velocity` for `duration` s: not to be played, but easy to reckon with.
inline trajectory::Path ramp(double from, double velocity, double duration) {
  trajectory::Polynomial polynomial;
  polynomial.coefficients = {from, velocity};
  return trajectory::Path({{GoalTime{0.0}, GoalTime{duration}, polynomial}});
}

inline trajectory::JointLimits limits() {
  trajectory::JointLimits limits;
  limits.min_position = -10.0;
  limits.max_position = 10.0;
  limits.max_velocity = 2.5;
  limits.max_acceleration = kMaxAcceleration;
  return limits;
}

class SetpointStreamTest : public testing::Test {
 protected:
  /// What the targets of the SYNCs in [from, to) ms are.
  void play(int from, int to) {
    for (int sync = from; sync < to; sync += 10) targets.push_back(*stream.next(at(sync)));
  }
  void expect_within_acceleration(double limit) const {
    for (std::size_t i = 2; i < targets.size(); ++i) {
      const double acceleration = (targets[i] - 2.0 * targets[i - 1] + targets[i - 2]) / (kCounts * 1e-4);
      EXPECT_LE(std::abs(acceleration), limit + 2.0 / (kCounts * 1e-4)) << i;
    }
  }

  SetpointStream stream{encoding_of(kCounts), limits()};
  std::vector<double> targets;
};

}  // namespace interpolated_motion::axis
