#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::axis {
namespace {

using std::chrono::milliseconds;

constexpr HostDuration kPeriod = milliseconds(10);
constexpr double kCounts = 1000.0;  // per rad

encoding::Transmission transmission() {
  encoding::Transmission t;
  t.counts_per_revolution = kCounts * 2.0 * 3.14159265358979324;
  return t;
}

HostTime at(int ms) { return HostTime{milliseconds(ms)}; }

/// From `from` at constant `velocity` for `duration` s: not to be played, but easy to reckon with.
trajectory::Path ramp(double from, double velocity, double duration) {
  trajectory::Polynomial polynomial;
  polynomial.coefficients = {from, velocity};
  return trajectory::Path({{GoalTime{0.0}, GoalTime{duration}, polynomial}});
}

class SetpointStreamTest : public testing::Test {
 protected:
  SetpointStream stream{transmission(), kPeriod, 3};
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

TEST_F(SetpointStreamTest, SkippedSyncsCountAsMissedAndShiftNothing) {
  stream.follow(ramp(1.0, 2.0, 0.5), at(1000));
  stream.next(at(1000));
  EXPECT_EQ(stream.missed(), 0U);
  EXPECT_EQ(stream.next(at(1040)), 1100);
  EXPECT_EQ(stream.missed(), 3U);
  stream.restart();
  stream.next(at(5000));
  EXPECT_EQ(stream.missed(), 3U);
}

TEST_F(SetpointStreamTest, BrakesFromTheNewestTargetOnSmoothly) {
  trajectory::JointLimits limits;
  limits.max_acceleration = 10.0;
  stream.follow(ramp(0.0, 2.0, 5.0), at(1000));
  std::vector<double> targets;
  for (int sync = 1000; sync < 1100; sync += 10) targets.push_back(*stream.next(at(sync)));
  stream.brake(limits);
  const double left_at = targets.back();
  EXPECT_EQ(left_at, 200.0);
  for (int sync = 1100; sync < 1600; sync += 10) targets.push_back(*stream.next(at(sync)));
  EXPECT_TRUE(stream.played(at(1600)));
  // 0.75 v^2 / a = 0.3 rad.
  EXPECT_NEAR(targets.back() - left_at, 300.0, 1.0);
  for (std::size_t i = 2; i < targets.size(); ++i) {
    const double acceleration = (targets[i] - 2.0 * targets[i - 1] + targets[i - 2]) / (kCounts * 1e-4);
    EXPECT_LE(std::abs(acceleration), 10.0 + 2.0 / (kCounts * 1e-4)) << i;
  }
}

// A smooth stop would take 0.3 rad where there are 0.22; full deceleration takes v^2 / 2a = 0.2.
TEST_F(SetpointStreamTest, BrakesHarderBeforeALimitOfPosition) {
  trajectory::JointLimits limits;
  limits.max_acceleration = 10.0;
  limits.min_position = -10.0;
  limits.max_position = 0.42;
  stream.follow(ramp(0.0, 2.0, 0.21), at(1000));
  for (int sync = 1000; sync < 1100; sync += 10) stream.next(at(sync));
  stream.brake(limits);
  std::int32_t most = 0;
  for (int sync = 1100; sync < 1600; sync += 10) most = std::max(most, *stream.next(at(sync)));
  EXPECT_NEAR(most, 400, 1);
  EXPECT_EQ(stream.newest_counts(), most);
}

TEST_F(SetpointStreamTest, BrakingBeforeTheBeginStaysAtTheStart) {
  trajectory::JointLimits limits;
  limits.max_acceleration = 10.0;
  stream.follow(ramp(1.0, 2.0, 0.5), at(1000));
  stream.next(at(900));
  stream.brake(limits);
  EXPECT_EQ(stream.next(at(910)), 1000);
  EXPECT_EQ(stream.next(at(1200)), 1000);
}

}  // namespace
}  // namespace interpolated_motion::axis
