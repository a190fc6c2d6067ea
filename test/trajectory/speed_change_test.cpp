#include "interpolated_motion_driver/trajectory/speed_change.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/path_builder.h"
#include "interpolated_motion_driver/trajectory/retime.h"

#include "goals.h"
#include "random.h"

namespace interpolated_motion::trajectory {
namespace {

/// Up to `speed` with `rise` s of constant acceleration, `cruise` s, and down again.
Path trapezoid(double speed, double rise, double cruise) {
  const double a = speed / rise;
  const double up = 0.5 * speed * rise;
  return Path({{GoalTime{0.0}, GoalTime{rise}, Polynomial{{0.0, 0.0, 0.5 * a}}},
               {GoalTime{rise}, GoalTime{rise + cruise}, Polynomial{{up, speed}}},
               {GoalTime{rise + cruise}, GoalTime{2 * rise + cruise},
                Polynomial{{up + speed * cruise, speed, -0.5 * a}}}});
}

// The slope rises in a quarter of the ramp, stays for half of it and falls in the last quarter.
TEST(SpeedChange, TakesTheRampWhereNothingHinders) {
  const std::vector<Path> paths{trapezoid(1.0, 0.5, 4.0)};
  const std::vector<JointLimits> limits{limits_of(2.0, 100.0)};
  for (const double rate : {0.0, 0.5, 1.5}) {
    const auto law = speed_changed(TimeLaw{}, GoalTime{1.0}, {rate, GoalTime{0.4}}, paths, limits);
    ASSERT_TRUE(law);
    EXPECT_EQ(law.value().final_rate(), rate);
    // For a change by 1; a smaller one has no time for the steepest slope.
    EXPECT_GT(law.value().steady_from().count(), 1.0 + 0.9 * 0.4 * std::abs(rate - 1.0));
    EXPECT_LT(law.value().steady_from().count(), 1.0 + 1.1 * 0.4);
    EXPECT_EQ(law.value().at(GoalTime{0.9}).rate, 1.0);
  }
}

TEST(SpeedChange, IsAsQuickAsTheAccelerationAllows) {
  const std::vector<Path> paths{trapezoid(1.0, 0.5, 4.0)};
  const std::vector<JointLimits> limits{limits_of(2.0, 2.0)};
  const auto law = speed_changed(TimeLaw{}, GoalTime{1.0}, {0.0, GoalTime{0.1}}, paths, limits);
  ASSERT_TRUE(law);
  // 1 rad/s at 2 rad/s^2 is 0.5 s; the ends are eased.
  EXPECT_GT(law.value().steady_from().count(), 1.5);
  EXPECT_LT(law.value().steady_from().count(), 1.6);
}

TEST(SpeedChange, WaitsForAJointThatBrakesWithAllItHas) {
  const std::vector<Path> paths{trapezoid(1.0, 0.5, 1.0)};
  const std::vector<JointLimits> limits{limits_of(1.0, 2.0)};
  const auto law = speed_changed(TimeLaw{}, GoalTime{1.7}, {0.0, GoalTime{0.1}}, paths, limits);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law.value().at(GoalTime{1.9}).nominal.count(), 1.9, 1e-3);
}

TEST(SpeedChange, GoesNoFasterThanTheLimitsAllow) {
  const std::vector<Path> paths{trapezoid(1.0, 0.5, 4.0)};
  EXPECT_NEAR(highest_rate(paths, GoalTime{0.0}, {limits_of(1.3, 100.0)}), 1.3, 1e-12);
  EXPECT_NEAR(highest_rate(paths, GoalTime{0.0}, {limits_of(9.0, 2.88)}), 1.2, 1e-12);
  EXPECT_EQ(highest_rate(paths, GoalTime{0.0}, {limits_of(9.0, 200.0)}), kHighestRate);
  EXPECT_EQ(highest_rate(paths, GoalTime{0.0}, {limits_of(0.99999, 2.0)}), 1.0);
  const auto law =
      speed_changed(TimeLaw{}, GoalTime{1.0}, {2.0, GoalTime{0.2}}, paths, {limits_of(1.3, 100.0)});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law.value().final_rate(), 1.3, 1e-12);
}

TEST(SpeedChange, IsAtOnceWhereNothingIsLeft) {
  const std::vector<Path> paths{trapezoid(1.0, 0.5, 1.0)};
  const auto law =
      speed_changed(TimeLaw{}, GoalTime{5.0}, {0.0, GoalTime{0.4}}, paths, {limits_of(1.0, 2.0)});
  ASSERT_TRUE(law);
  EXPECT_EQ(law.value().steady_from().count(), 5.0);
  EXPECT_EQ(law.value().final_rate(), 0.0);
}

/// A joint's way through random points with their accelerations, the worst of it at the limits.
struct RandomJoint {
  Path path;
  JointLimits limits;
};

RandomJoint random_joint(Random& random, double duration) {
  std::vector<Knot> knots;
  const int points = 8;
  for (int i = 0; i <= points; ++i) {
    const bool end = i == 0 || i == points;
    knots.push_back({GoalTime{duration * i / points},
                     {random.uniform(-1.0, 1.0), end ? 0.0 : random.uniform(-0.7, 0.7),
                      end ? 0.0 : random.uniform(-2.0, 2.0)},
                     KnotData::Acceleration});
  }
  RandomJoint joint{build_path(knots), {}};
  double velocity = 0.0;
  double acceleration = 0.0;
  for (double t = 0.0; t < duration; t += 1e-3) {
    const State state = joint.path.sample(GoalTime{t});
    velocity = std::max(velocity, std::abs(state.velocity));
    acceleration = std::max(acceleration, std::abs(state.acceleration));
  }
  joint.limits = limits_of(1.0001 * velocity, 1.0001 * acceleration);
  return joint;
}

// Whatever was wished for: from any instant on and at any rate the joints are on their common way, never go
// back, keep their limits as a drive would see them, and come to the rate that was asked for.
TEST(SpeedChange, KeepsWayAndLimitsOfRandomMotions) {
  Random random(7);
  double slowest = 0.0;
  for (int i = 0; i < property_cases(60); ++i) {
    const double duration = random.uniform(2.0, 8.0);
    std::vector<Path> nominal;
    std::vector<JointLimits> limits;
    for (int joint = 0; joint < 3; ++joint) {
      RandomJoint made = random_joint(random, duration);
      nominal.push_back(std::move(made.path));
      limits.push_back(made.limits);
    }
    TimeLaw law;
    GoalTime from{0.0};
    for (int change = 0; change < 3; ++change) {
      from += GoalTime{random.uniform(0.05, 1.0)};
      const double rate = change == 1 ? random.uniform(0.0, 0.4) : random.uniform(0.0, 2.0);
      const auto changed = speed_changed(law, from, {rate, GoalTime{0.2}}, nominal, limits);
      ASSERT_TRUE(changed) << "case " << i;
      law = changed.value();
      if (rate <= 1.0) {
        EXPECT_EQ(law.final_rate(), rate);
      }
      slowest = std::max(slowest, (law.steady_from() - from).count());
    }
    GoalTime before{-1.0};
    for (double t = 0.0; t < 3.0 * duration; t += 2e-3) {
      const TimeLaw::Instant now = law.at(GoalTime{t});
      ASSERT_GE(now.rate, 0.0);
      ASSERT_GE(now.nominal, before);
      before = now.nominal;
    }
    for (std::size_t joint = 0; joint < nominal.size(); ++joint) {
      const Path path = retimed(nominal[joint], law, GoalTime{0.0});
      for (double t = 0.0; t < 3.0 * duration; t += 2e-3) {
        const State state = path.sample(GoalTime{t});
        ASSERT_NEAR(state.position, nominal[joint].sample(law.at(GoalTime{t}).nominal).position, 1e-7)
            << "case " << i << " joint " << joint << " at " << t;
        ASSERT_LE(std::abs(state.velocity), 1.001 * limits[joint].max_velocity);
        ASSERT_LE(std::abs(state.acceleration), 1.001 * limits[joint].max_acceleration);
      }
    }
  }
  RecordProperty("slowest change, s", std::to_string(slowest));
}

}  // namespace
}  // namespace interpolated_motion::trajectory
