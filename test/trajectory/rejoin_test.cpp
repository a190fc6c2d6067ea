#include "interpolated_motion_driver/trajectory/rejoin.h"

#include <cmath>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/rest_to_rest.h"

namespace interpolated_motion::trajectory {
namespace {

constexpr GoalTime kShortest{0.06};
constexpr GoalTime kLongest{0.5};

JointLimits limits() {
  JointLimits limits;
  limits.min_position = -3.0;
  limits.max_position = 3.0;
  limits.max_velocity = 3.5;
  limits.max_acceleration = 20.0;
  return limits;
}

/// 2 rad from goal time 1 s to 3 s, at most 1.9 rad/s and 2.9 rad/s^2.
Path path() { return Path({rest_to_rest(0.0, 2.0, GoalTime{1.0}, GoalTime{2.0})}); }

void expect_continuous(const Path& path, const State& from) {
  State before = from;
  for (const Piece& piece : path.pieces()) {
    const State first = piece.polynomial.state(0.0);
    EXPECT_NEAR(first.position, before.position, 1e-9);
    EXPECT_NEAR(first.velocity, before.velocity, 1e-9);
    EXPECT_NEAR(first.acceleration, before.acceleration, 1e-7);
    before = piece.polynomial.state(piece.duration().count());
  }
}

TEST(Rejoin, GoesBackToThePathAndAlongIt) {
  const State there = path().sample(GoalTime{1.7});
  const State from{there.position + 1e-3, there.velocity - 0.02, there.acceleration + 1.0};
  const auto back = rejoin(path(), from, GoalTime{1.7}, limits(), 1.1, kShortest, kLongest);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->start_time(), GoalTime{1.7});
  EXPECT_NEAR(back->end_time().count(), 3.0, 1e-12);
  expect_continuous(*back, from);
  for (double t = 1.761; t < 3.1; t += 0.0371) {
    EXPECT_NEAR(back->sample(GoalTime{t}).position, path().sample(GoalTime{t}).position, 1e-12) << t;
  }
}

TEST(Rejoin, TakesLongerWhereTheJointIsFartherAstray) {
  const State there = path().sample(GoalTime{1.7});
  const State from{there.position + 0.02, there.velocity, there.acceleration};
  const auto back = rejoin(path(), from, GoalTime{1.7}, limits(), 1.0, kShortest, kLongest);
  ASSERT_TRUE(back);
  EXPECT_GT(back->pieces().front().duration(), kShortest);
  EXPECT_FALSE(find_limit_violation(*back, limits()));
  expect_continuous(*back, from);
}

TEST(Rejoin, BehindTheEndGoesToRestThere) {
  const State from{2.001, 0.01, 0.0};
  const auto back = rejoin(path(), from, GoalTime{2.99}, limits(), 1.0, kShortest, kLongest);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->end_time().count(), 3.05, 1e-12);
  EXPECT_NEAR(back->final_position(), 2.0, 1e-12);
  expect_continuous(*back, from);
}

TEST(Rejoin, BeforeTheBeginWaitsForIt) {
  const auto back = rejoin(path(), {0.001, 0.0, 0.0}, GoalTime{0.5}, limits(), 1.0, kShortest, kLongest);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->pieces().size(), 3U);
  EXPECT_NEAR(back->sample(GoalTime{0.8}).position, 0.0, 1e-12);
  EXPECT_NEAR(back->sample(GoalTime{2.0}).position, 1.0, 1e-12);
}

TEST(Rejoin, IsImpossibleWhereTheLimitsAreTooNarrow) {
  const State there = path().sample(GoalTime{1.7});
  EXPECT_FALSE(
      rejoin(path(), {there.position + 2.0, 0.0, 0.0}, GoalTime{1.7}, limits(), 1.0, kShortest, kLongest));
  EXPECT_FALSE(rejoin(path(), {there.position, there.velocity, 25.0}, GoalTime{1.7}, limits(), 1.0, kShortest,
                      kLongest));
}

// It cannot be helped that it is outside; it is to go back.
TEST(Rejoin, FromOutsideThePositionsGoesInwards) {
  JointLimits narrow = limits();
  narrow.max_position = 2.0;
  const auto back = rejoin(path(), {2.003, 0.0, 0.0}, GoalTime{3.2}, narrow, 1.0, kShortest, kLongest);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->final_position(), 2.0, 1e-12);
}

// Nor that it is too fast already; it is not to become faster.
TEST(Rejoin, FromBeyondTheVelocityBecomesSlower) {
  JointLimits slow = limits();
  slow.max_velocity = 1.9;
  const State there = path().sample(GoalTime{2.0});
  const auto back = rejoin(path(), {there.position, 2.2, 0.0}, GoalTime{2.0}, slow, 1.0, kShortest, kLongest);
  ASSERT_TRUE(back);
  for (double t = 2.0; t <= 3.0; t += 1e-3) EXPECT_LE(back->sample(GoalTime{t}).velocity, 2.2 + 1e-9) << t;
}

}  // namespace
}  // namespace interpolated_motion::trajectory
