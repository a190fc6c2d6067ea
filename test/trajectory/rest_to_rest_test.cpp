#include "interpolated_motion_driver/trajectory/rest_to_rest.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/stop_path.h"
#include "trajectory/goals.h"
#include "trajectory/random.h"

namespace interpolated_motion::trajectory {
namespace {

TEST(RestToRest, GoesFromRestToRest) {
  const Piece piece = rest_to_rest(1.0, -2.0, GoalTime(3), GoalTime(0.5));
  const State start = piece.polynomial.state(0);
  const State end = piece.polynomial.state(0.5);
  EXPECT_EQ(start.position, 1.0);
  EXPECT_EQ(start.velocity, 0.0);
  EXPECT_EQ(start.acceleration, 0.0);
  EXPECT_NEAR(end.position, -2.0, 1e-14);
  EXPECT_NEAR(end.velocity, 0.0, 1e-12);
  EXPECT_NEAR(end.acceleration, 0.0, 1e-10);
  EXPECT_EQ(piece.start.count(), 3.0);
  EXPECT_EQ(piece.end.count(), 3.5);
}

TEST(RestToRestDuration, OfNoDistanceOrNoLimitsIsZero) {
  EXPECT_EQ(rest_to_rest_duration(0.0, limits_of(1, 1)).count(), 0.0);
  EXPECT_EQ(rest_to_rest_duration(1.0, {}).count(), 0.0);
}

TEST(RestToRestDuration, IsTheLeastWithinTheLimits) {
  Random random(6);
  for (int n = 0; n < property_cases(200); ++n) {
    const double distance = random.uniform(-3, 3);
    const JointLimits limits = limits_of(random.uniform(0.1, 5), random.uniform(0.1, 50));
    const GoalTime duration = rest_to_rest_duration(distance, limits);
    EXPECT_FALSE(find_limit_violation(Path({rest_to_rest(0, distance, GoalTime(0), duration)}), limits));
    EXPECT_TRUE(
        find_limit_violation(Path({rest_to_rest(0, distance, GoalTime(0), 0.999 * duration)}), limits));
  }
}

TEST(RestToRestDuration, UsesAPartOfTheLimits) {
  EXPECT_DOUBLE_EQ(rest_to_rest_duration(1.0, limits_of(1, 1e9), 0.5).count(), 3.75);
}

TEST(StopPath, ComesToRestWithinTheAcceleration) {
  Random random(7);
  for (int n = 0; n < property_cases(200); ++n) {
    const State from{random.uniform(-1, 1), random.uniform(-3, 3), random.uniform(-3, 3)};
    const JointLimits limits = limits_of(std::abs(from.velocity), random.uniform(1, 20));
    const Path path = stop_path(from, GoalTime(2), limits);
    const State start = path.sample(GoalTime(2));
    EXPECT_EQ(start.position, from.position);
    EXPECT_EQ(start.velocity, from.velocity);
    EXPECT_NEAR(path.sample(path.end_time()).velocity, 0.0, 1e-12);
    EXPECT_FALSE(find_limit_violation(path, limits));
    const double duration = (path.end_time() - path.start_time()).count();
    EXPECT_NEAR(path.final_position(), from.position + 0.5 * from.velocity * duration, 1e-12);
    EXPECT_NEAR(duration, std::max(1.5 * std::abs(from.velocity) / limits.max_acceleration, 0.02), 1e-12);
  }
}

TEST(StopPath, NeverReverses) {
  const Path path = stop_path({0, 2, 0}, GoalTime(0), limits_of(10, 4));
  for (int i = 0; i <= 100; ++i) EXPECT_GE(path.sample(GoalTime(0.0075 * i)).velocity, -1e-12);
}

TEST(StopPath, OfAJointAtRestRests) {
  const Path path = stop_path({1.5, 0, 3}, GoalTime(2), limits_of(1, 1));
  EXPECT_TRUE(path.empty());
  EXPECT_EQ(path.final_position(), 1.5);
}

TEST(StopPath, NeedsAnAcceleration) {
  EXPECT_THROW(stop_path({0, 1, 0}, GoalTime(0), limits_of(1, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace interpolated_motion::trajectory
