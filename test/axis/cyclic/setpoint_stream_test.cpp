#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::axis {
namespace {

using std::chrono::milliseconds;

constexpr double kCounts = 1000.0;  // per rad
constexpr double kMaxAcceleration = 10.0;

encoding::SetpointEncoding encoding_of(double counts) {
  encoding::SetpointEncoding encoding;
  encoding.transmission.counts_per_revolution = counts * 2.0 * 3.14159265358979324;
  return encoding;
}

HostTime at(int ms) { return HostTime{milliseconds(ms)}; }

/// From `from` at constant `velocity` for `duration` s: not to be played, but easy to reckon with.
trajectory::Path ramp(double from, double velocity, double duration) {
  trajectory::Polynomial polynomial;
  polynomial.coefficients = {from, velocity};
  return trajectory::Path({{GoalTime{0.0}, GoalTime{duration}, polynomial}});
}

trajectory::JointLimits limits() {
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

TEST_F(SetpointStreamTest, RestsWhereItIsTold) {
  stream.rest(-7);
  EXPECT_EQ(stream.next(at(100)), -7);
  EXPECT_EQ(stream.newest(), at(110));
}

TEST_F(SetpointStreamTest, OneForEachSync) {
  stream.rest(5);
  EXPECT_TRUE(stream.next(at(100)));
  EXPECT_FALSE(stream.next(at(100)));
  EXPECT_TRUE(stream.next(at(110)));
  EXPECT_FALSE(stream.next(kNever));
}

// The drive reaches what it gets with the SYNC at 1000 ms at 1010 ms, 30 ms after the begin.
TEST_F(SetpointStreamTest, TargetBelongsToTheInstantAtWhichItIsReached) {
  stream.follow(ramp(1.0, 2.0, 0.5), at(980));
  EXPECT_EQ(stream.next(at(1000)), 1060);
  EXPECT_EQ(stream.next(at(1010)), 1080);
}

TEST_F(SetpointStreamTest, RestsAtTheStartUntilTheBeginAndAtTheEndFromThenOn) {
  stream.follow(ramp(1.0, 2.0, 0.5), at(1000));
  EXPECT_EQ(stream.next(at(900)), 1000);
  EXPECT_EQ(stream.next(at(1490)), 2000);
  EXPECT_EQ(stream.next(at(1600)), 2000);
}

// A cubic through the last four: the three older ones must have passed the end as well.
TEST_F(SetpointStreamTest, IsPlayedWhenTheDriveHasOnlyTheEndInItsHistory) {
  stream.follow(ramp(1.0, 2.0, 0.5), at(1000));
  for (int sync = 1000; sync <= 1510; sync += 10) stream.next(at(sync));
  EXPECT_FALSE(stream.played(at(1530)));  // the one for 1530 ms has not been sent
  stream.next(at(1520));
  EXPECT_FALSE(stream.played(at(1529)));
  EXPECT_TRUE(stream.played(at(1530)));
}

// On a straight line the drive has gone on as the path does.
TEST_F(SetpointStreamTest, SkippedSyncsCountAsMissedAndShiftNothing) {
  stream.follow(ramp(1.0, 2.0, 0.5), at(1000));
  play(1000, 1100);
  EXPECT_EQ(stream.missed(), 0U);
  EXPECT_EQ(stream.next(at(1140)), 1300);
  EXPECT_EQ(stream.missed(), 4U);
  EXPECT_FALSE(stream.astray());
  stream.restart();
  stream.next(at(5000));
  EXPECT_EQ(stream.missed(), 4U);
}

// 4 rad/s^2 are taken from the path while the host is away for 4 periods; the drive goes straight on. It
// comes back as it can.
TEST_F(SetpointStreamTest, ComesBackFromWhereTheDriveHasGoneWithinTheLimits) {
  trajectory::Polynomial straight{{0.0, 2.0}};
  trajectory::Polynomial bent{{0.6, 2.0, -2.0}};
  stream.follow(
      trajectory::Path({{GoalTime{0.0}, GoalTime{0.3}, straight}, {GoalTime{0.3}, GoalTime{0.8}, bent}}),
      at(1000));
  play(1000, 1300);
  EXPECT_EQ(targets.back(), 600.0);
  targets.clear();
  const double first = *stream.next(at(1340));
  EXPECT_EQ(first, 700.0) << "the drive's polynomial";
  targets = {first - 40.0, first - 20.0, first};
  play(1350, 1700);
  EXPECT_EQ(targets.back(), 600.0 + 2000.0 * 0.4 - 2000.0 * 0.16);
  expect_within_acceleration(1.1 * kMaxAcceleration);
}

TEST_F(SetpointStreamTest, IsAstrayWhereNoWayBackKeepsTheLimits) {
  stream.follow(ramp(0.0, 2.0, 5.0), at(1000));
  play(1000, 1100);
  trajectory::Polynomial back{{0.2, -2.0}};
  stream.follow(trajectory::Path({{GoalTime{0.1}, GoalTime{5.0}, back}}), at(1100));
  EXPECT_EQ(stream.next(at(1140)), 300) << "goes on as it went until it is stopped";
  EXPECT_TRUE(stream.astray());
  EXPECT_EQ(stream.next(at(1150)), 320);
  stream.rest(320);
  EXPECT_FALSE(stream.astray());
}

TEST_F(SetpointStreamTest, BrakesFromTheNewestTargetOnSmoothly) {
  stream.follow(ramp(0.0, 2.0, 5.0), at(1000));
  play(1000, 1100);
  stream.brake();
  const double left_at = targets.back();
  EXPECT_EQ(left_at, 200.0);
  play(1100, 1600);
  EXPECT_TRUE(stream.played(at(1600)));
  // 2 rad/s at 9 rad/s^2, reached in 60 ms: with 50 ms the cubics through the targets go 0.5 % beyond the
  // limit.
  EXPECT_NEAR(targets.back() - left_at, 1e3 * 0.5 * 2.0 * (2.0 / 9.0 + 0.06), 1.0);
  expect_within_acceleration(kMaxAcceleration);
}

// Of a fine encoder: what whole counts bend a polynomial by, continued over three periods, is not to hide it.
TEST_F(SetpointStreamTest, BrakesOnFromWhereTheDriveHasGoneWhileTheHostWasAway) {
  constexpr double kFiner = 100.0;
  SetpointStream exact(encoding_of(kCounts * kFiner), limits());
  exact.follow(ramp(0.0, 2.0, 5.0), at(1000));
  for (int sync = 1000; sync < 1100; sync += 10) exact.next(at(sync));
  exact.brake();
  for (int sync = 1100; sync < 1150; sync += 10) targets.push_back(*exact.next(at(sync)) / kFiner);
  const double before = targets.back();
  targets = {*exact.next(at(1180)) / kFiner};
  EXPECT_GT(targets.front(), before + 50.0) << "as the polynomial has bent until then";
  EXPECT_LT(targets.front(), before + 80.0) << "at 2 rad/s";
  for (int sync = 1190; sync < 1700; sync += 10) targets.push_back(*exact.next(at(sync)) / kFiner);
  EXPECT_FALSE(exact.astray());
  EXPECT_TRUE(exact.played(at(1700)));
  expect_within_acceleration(kMaxAcceleration);
}

// With the shortest ramps, 30 ms, a smooth stop takes 0.25 rad, with 40 ms 0.26 rad; full deceleration takes
// v^2 / 2a = 0.2.
TEST_F(SetpointStreamTest, BrakesHarderBeforeALimitOfPosition) {
  for (const auto& [limit, expected] : {std::pair{0.47, 462}, std::pair{0.42, 400}}) {
    trajectory::JointLimits narrow = limits();
    narrow.max_position = limit;
    SetpointStream near(encoding_of(kCounts), narrow);
    near.follow(ramp(0.0, 2.0, 0.21), at(1000));
    for (int sync = 1000; sync < 1100; sync += 10) near.next(at(sync));
    near.brake();
    std::int32_t most = 0;
    for (int sync = 1100; sync < 1600; sync += 10) most = std::max(most, *near.next(at(sync)));
    EXPECT_NEAR(most, expected, 1) << limit;
    EXPECT_EQ(near.newest_counts(), most);
  }
}

// A setpoint that comes while the drive is on its way back gives a new path: the drive is not on that one
// yet.
TEST_F(SetpointStreamTest, ANewPathIsMetFromTheWayBack) {
  const trajectory::Polynomial straight{{0.0, 2.0}};
  const trajectory::Polynomial bent{{0.6, 2.0, -2.0}};
  const trajectory::Path path(
      {{GoalTime{0.0}, GoalTime{0.3}, straight}, {GoalTime{0.3}, GoalTime{0.8}, bent}});
  constexpr double kFiner = 100.0;
  SetpointStream exact(encoding_of(kCounts * kFiner), limits());
  const auto play_exact = [&](int from, int to) {
    for (int sync = from; sync < to; sync += 10) targets.push_back(*exact.next(at(sync)) / kFiner);
  };
  exact.follow(path, at(1000));
  play_exact(1000, 1300);
  targets.clear();
  play_exact(1340, 1370);
  exact.follow(path, at(1000));
  play_exact(1370, 1700);
  EXPECT_NEAR(targets.back(), 600.0 + 2000.0 * 0.4 - 2000.0 * 0.16, 0.01);
  for (std::size_t i = 2; i < targets.size(); ++i) {
    const double acceleration = (targets[i] - 2.0 * targets[i - 1] + targets[i - 2]) / (kCounts * 1e-4);
    EXPECT_LE(std::abs(acceleration), 1.1 * kMaxAcceleration + 0.2) << i << ": two counts are 0.2 rad/s^2";
  }
}

TEST_F(SetpointStreamTest, BrakingBeforeTheBeginStaysAtTheStart) {
  stream.follow(ramp(1.0, 2.0, 0.5), at(1000));
  stream.next(at(900));
  stream.brake();
  EXPECT_EQ(stream.next(at(910)), 1000);
  EXPECT_EQ(stream.next(at(1200)), 1000);
}

}  // namespace
}  // namespace interpolated_motion::axis
