#include "interpolated_motion_driver/trajectory/jerk_limited_stop.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "trajectory/random.h"

namespace interpolated_motion::trajectory {
namespace {

constexpr GoalTime kStart{2.0};

/// Largest |acceleration| and |jerk| at the ends and in the middle of each piece, and the largest step
/// between pieces.
struct Extremes {
  double acceleration = 0.0;
  double jerk = 0.0;
  double step = 0.0;
};

Extremes extremes(const State& from, const Path& path) {
  Extremes found;
  State before = from;
  for (const Piece& piece : path.pieces()) {
    const double length = piece.duration().count();
    const State first = piece.polynomial.state(0.0);
    const State last = piece.polynomial.state(length);
    found.step = std::max({found.step, std::abs(first.position - before.position),
                           std::abs(first.velocity - before.velocity),
                           std::abs(first.acceleration - before.acceleration)});
    found.acceleration =
        std::max({found.acceleration, std::abs(first.acceleration), std::abs(last.acceleration)});
    found.jerk = std::max(found.jerk, std::abs(last.acceleration - first.acceleration) / length);
    before = last;
  }
  found.step = std::max({found.step, std::abs(before.velocity), std::abs(before.acceleration)});
  return found;
}

TEST(JerkLimitedStop, ContinuesTheStateAndRestsWithoutAStepInAcceleration) {
  Random random(11);
  for (int n = 0; n < property_cases(2000); ++n) {
    const Braking braking{random.uniform(0.5, 30.0), GoalTime{random.uniform(0.01, 0.3)}};
    const State from{random.uniform(-1, 1), random.uniform(-4, 4),
                     random.uniform(-1, 1) * braking.max_acceleration};
    const Path path = jerk_limited_stop(from, kStart, braking);
    const Extremes found = extremes(from, path);
    EXPECT_LE(found.step, 1e-9) << n;
    EXPECT_LE(found.acceleration, braking.max_acceleration + 1e-9) << n;
    EXPECT_LE(found.jerk, kHardestRamp * braking.max_acceleration / braking.ramp.count() + 1e-6) << n;
    EXPECT_EQ(path.start_time(), kStart);
  }
}

TEST(JerkLimitedStop, TakesTheTimeOfTheDecelerationAndOneRamp) {
  const Path path = jerk_limited_stop({1.0, -3.0, 0.0}, kStart, {20.0, GoalTime{0.08}});
  EXPECT_NEAR((path.end_time() - kStart).count(), 3.0 / 20.0 + 0.08, 1e-12);
  EXPECT_NEAR(path.final_position(), 1.0 - 0.5 * 3.0 * (3.0 / 20.0 + 0.08), 1e-12);
}

// From 0.2 rad/s no more than sqrt(v j) = 7.1 rad/s^2 is reached, in two ramps.
TEST(JerkLimitedStop, OfASlowJointIsTwoRamps) {
  const Path path = jerk_limited_stop({0.0, 0.2, 0.0}, kStart, {20.0, GoalTime{0.08}});
  const double ramp = std::sqrt(0.2 / 250.0);
  EXPECT_EQ(path.pieces().size(), 2U);
  EXPECT_NEAR((path.end_time() - kStart).count(), 2.0 * ramp, 1e-12);
}

TEST(JerkLimitedStop, GoesOnBrakingWhereTheJointAlreadyDoes) {
  const Path path = jerk_limited_stop({0.0, 3.0, -20.0}, kStart, {20.0, GoalTime{0.08}});
  EXPECT_EQ(path.pieces().front().polynomial.coefficients[3], 0.0);
  EXPECT_NEAR((path.end_time() - kStart).count(), 3.0 / 20.0 + 0.04, 1e-12);
}

// 20 rad/s^2 down to 0 in 0.08 s would take 0.8 rad/s; there are 0.5, so the ramp lasts 0.05 s.
TEST(JerkLimitedStop, EasesOffMoreQuicklyThanItWouldTurnRound) {
  const Path path = jerk_limited_stop({0.0, 0.5, -20.0}, kStart, {20.0, GoalTime{0.08}});
  EXPECT_NEAR((path.end_time() - kStart).count(), 0.05, 1e-12);
  for (int i = 0; i <= 100; ++i) EXPECT_GE(path.sample(kStart + GoalTime{0.0005 * i}).velocity, -1e-9);
}

TEST(JerkLimitedStop, OfAJointAtRestRests) {
  const Path path = jerk_limited_stop({1.5, 0.0, 0.0}, kStart, {20.0, GoalTime{0.08}});
  EXPECT_TRUE(path.empty());
  EXPECT_EQ(path.final_position(), 1.5);
}

// Where a path turns round it has an acceleration and no velocity: what is left of it is gone in a moment.
TEST(JerkLimitedStop, InATurningPointSwingsOnByLittle) {
  const Path path = jerk_limited_stop({1.5, 0.0, 20.0}, kStart, {20.0, GoalTime{0.08}});
  EXPECT_LE(extremes({1.5, 0.0, 20.0}, path).step, 1e-9);
  EXPECT_NEAR(path.final_position(), 1.5, 20.0 * 0.08 * 0.08);
}

TEST(JerkLimitedStop, NeedsAnAccelerationAndARamp) {
  EXPECT_THROW(jerk_limited_stop({0, 1, 0}, kStart, {0.0, GoalTime{0.1}}), std::invalid_argument);
  EXPECT_THROW(jerk_limited_stop({0, 1, 0}, kStart, {1.0, GoalTime{0.0}}), std::invalid_argument);
}

}  // namespace
}  // namespace interpolated_motion::trajectory
