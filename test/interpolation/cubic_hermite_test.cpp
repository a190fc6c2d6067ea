#include "interpolated_motion_driver/interpolation/cubic_hermite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace interpolated_motion::interpolation {
namespace {

/// Section 4.2.3 as printed, n and n-1 exchanged in a and b.
struct PrintedCubic {
  PrintedCubic(HermiteKnot from, HermiteKnot to, double t)
      : a((2 * (to.position - from.position) + t * (to.velocity + from.velocity)) / (t * t * t)),
        b((3 * (to.position - from.position) + t * (to.velocity + 2 * from.velocity)) / (t * t)),
        c(to.velocity),
        d(to.position) {}
  double position(double s) const { return a * s * s * s + b * s * s + c * s + d; }
  double velocity(double s) const { return 3 * a * s * s + 2 * b * s + c; }
  double a, b, c, d;
};

constexpr HermiteKnot kFrom{100, 7};
constexpr HermiteKnot kTo{400, 11};
constexpr double kDuration = 20;

TEST(CubicHermite, CoefficientsAsPrintedMissTheirOwnStart) {
  const PrintedCubic printed(kFrom, kTo, kDuration);
  EXPECT_NEAR(printed.position(-kDuration), 620, 1e-9);
  EXPECT_NEAR(printed.velocity(-kDuration), 15, 1e-9);
  EXPECT_EQ(printed.position(0), 400);
}

TEST(CubicHermite, MeetsBothKnots) {
  const CubicHermite cubic(kFrom, kTo, kDuration);
  EXPECT_NEAR(cubic.position(-kDuration), 100, 1e-12);
  EXPECT_NEAR(cubic.velocity(-kDuration), 7, 1e-12);
  EXPECT_NEAR(cubic.position(0), 400, 1e-12);
  EXPECT_NEAR(cubic.velocity(0), 11, 1e-12);
}

/// The same motion written from the segment's start: a cubic known by its own coefficients is reproduced
/// everywhere.
TEST(CubicHermite, ReproducesACubic) {
  const auto position = [](double t) { return 5 - 3 * t + 0.25 * t * t - 0.004 * t * t * t; };
  const auto velocity = [](double t) { return -3 + 0.5 * t - 0.012 * t * t; };
  const auto acceleration = [](double t) { return 0.5 - 0.024 * t; };
  const CubicHermite cubic({position(0), velocity(0)}, {position(80), velocity(80)}, 80);
  for (int k = 0; k <= 80; ++k) {
    EXPECT_NEAR(cubic.position_at(k), position(k), 1e-9);
    EXPECT_NEAR(cubic.velocity_at(k), velocity(k), 1e-11);
    EXPECT_NEAR(cubic.acceleration_at(k), acceleration(k), 1e-12);
  }
}

TEST(CubicHermite, PeakVelocityIsAtTheVertexOfARestToRestMove) {
  // From rest to rest over D in T the peak is 3 D / (2 T) in the middle, the acceleration 6 D / T^2 at the
  // ends.
  const CubicHermite cubic({1000, 0}, {400, 0}, 50);
  EXPECT_NEAR(cubic.peak_velocity(), 18, 1e-12);
  EXPECT_NEAR(cubic.peak_acceleration(), 1.44, 1e-12);
}

TEST(CubicHermite, PeaksOfRestAndOfConstantVelocityAreExact) {
  EXPECT_EQ(CubicHermite({-7, 0}, {-7, 0}, 255).peak_velocity(), 0);
  EXPECT_EQ(CubicHermite({-7, 0}, {-7, 0}, 255).peak_acceleration(), 0);
  EXPECT_EQ(CubicHermite({0, -2}, {-20, -2}, 10).peak_velocity(), 2);
  EXPECT_EQ(CubicHermite({0, -2}, {-20, -2}, 10).peak_acceleration(), 0);
}

TEST(CubicHermite, PeaksBoundDenseSamplesAndAreReached) {
  std::mt19937_64 engine(4711);
  const auto uniform = [&](double a) {
    return a * (static_cast<double>(engine() >> 11) / 4503599627370496.0 - 1.0);
  };
  for (int n = 0; n < 500; ++n) {
    const double duration = 1.0 + static_cast<double>(engine() % 255);
    const CubicHermite cubic({uniform(2000), uniform(50)}, {uniform(2000), uniform(50)}, duration);
    double velocity = 0;
    double acceleration = 0;
    constexpr int kSteps = 2000;
    for (int i = 0; i <= kSteps; ++i) {
      const double s = -duration + duration * i / kSteps;
      velocity = std::max(velocity, std::abs(cubic.velocity(s)));
      acceleration = std::max(acceleration, std::abs(cubic.acceleration(s)));
    }
    EXPECT_LE(velocity, cubic.peak_velocity() * (1 + 1e-12));
    EXPECT_GE(velocity, cubic.peak_velocity() * (1 - 1e-4) - 1e-4 * acceleration);
    EXPECT_NEAR(acceleration, cubic.peak_acceleration(), 1e-9 * acceleration);
  }
}

TEST(MotorUnits, RpmAndCountsPerMillisecond) {
  // 3000 rpm are 50 rev/s; 2000 counts/rev make 100 counts/ms. 1000 rpm/s are 1/30 counts/ms^2.
  EXPECT_DOUBLE_EQ(counts_per_ms(3000, 2000), 100);
  EXPECT_DOUBLE_EQ(rpm(100, 2000), 3000);
  EXPECT_DOUBLE_EQ(counts_per_ms2(1000, 2000), 1.0 / 30);
  EXPECT_DOUBLE_EQ(rpm_per_second(1.0 / 30, 2000), 1000);
}

}  // namespace
}  // namespace interpolated_motion::interpolation
