#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"
#include "interpolated_motion_driver/trajectory/path.h"

#include "axis/cyclic/setpoint_stream_fixture.h"

namespace interpolated_motion::axis {
namespace {

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
  play(900, 1540);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(targets[i], 1000.0) << i;
  for (std::size_t i = 59; i < targets.size(); ++i) EXPECT_EQ(targets[i], 2000.0) << i;
  EXPECT_EQ(stream.next(at(1600)), 2000);
}

// A drive that has missed the whole motion stands at its start.
TEST_F(SetpointStreamTest, DoesNotJumpToTheEndOfAMotionThatWasMissed) {
  stream.follow(ramp(1.0, 0.1, 0.05), at(1000));
  play(900, 990);
  const std::int32_t first = *stream.next(at(1100));
  EXPECT_EQ(first, 1000);
  play(1110, 1300);
  EXPECT_EQ(targets.back(), 1005.0);
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

// The target position for the SYNC of 1100 ms has been sent, and is not taken: its place in the drive is
// taken by the next one. Of x = 10 t^3 rad from 1000 ms on.
TEST_F(SetpointStreamTest, TheTargetOfASyncThatIsLeftOutIsNotTheDrives) {
  constexpr double kFiner = 1000.0;
  SetpointStream exact(encoding_of(kCounts * kFiner), limits());
  exact.follow(trajectory::Path({{GoalTime{0.0}, GoalTime{0.6}, {{0.0, 0.0, 0.0, 10.0}}}}), at(1000));
  for (int sync = 1000; sync <= 1100; sync += 10) exact.next(at(sync));
  exact.leave_out(at(1100), at(1100));
  EXPECT_EQ(exact.newest(), at(1100));
  EXPECT_NEAR(*exact.next(at(1110)), 1e6 * 10.0 * 0.12 * 0.12 * 0.12, 25.0) << "a cubic goes on as it is";
  EXPECT_EQ(exact.newest(), at(1120));
  EXPECT_EQ(exact.missed(), 1U);
  exact.leave_out(at(1100), at(1100));
  EXPECT_EQ(exact.newest(), at(1120)) << "told twice";
  EXPECT_NEAR(*exact.next(at(1120)), 1e6 * 10.0 * 0.13 * 0.13 * 0.13, 25.0);
  EXPECT_EQ(exact.missed(), 1U);
}

TEST_F(SetpointStreamTest, WhatGoesOnWithoutTheOneBeforeTheNewestStaysAsItIs) {
  stream.follow(ramp(1.0, 2.0, 0.5), at(1000));
  play(1000, 1110);
  stream.leave_out(at(1090), at(1090));
  EXPECT_EQ(stream.newest(), at(1110));
  EXPECT_EQ(stream.missed(), 1U);
  EXPECT_EQ(stream.next(at(1110)), 1240);
}

// The drive has braked until the newest target position and would go on doing so.
TEST_F(SetpointStreamTest, ASyncLeftOutAtTheEndIsMadeUpForToo) {
  constexpr double kFiner = 1000.0;
  SetpointStream exact(encoding_of(kCounts * kFiner), limits());
  const trajectory::Polynomial braking{{0.0, 2.0, -5.0}};
  exact.follow(trajectory::Path({{GoalTime{0.0}, GoalTime{0.2}, braking}}), at(1000));
  for (int sync = 1000; sync <= 1200; sync += 10) exact.next(at(sync));
  exact.leave_out(at(1200), at(1200));
  const double there = 0.2 - 5.0 * 0.02 * 0.02;
  EXPECT_NEAR(*exact.next(at(1210)), 1e6 * there, 25.0);
  EXPECT_FALSE(exact.played(at(1230)));
  for (int sync = 1220; sync <= 1600; sync += 10) exact.next(at(sync));
  EXPECT_FALSE(exact.astray());
  EXPECT_TRUE(exact.played(at(1600)));
  EXPECT_EQ(exact.newest_counts(), 200000);
}

TEST_F(SetpointStreamTest, ASyncLeftOutAtRestShiftsNothing) {
  stream.rest(5);
  play(1000, 1050);
  stream.leave_out(at(1040), at(1040));
  EXPECT_EQ(stream.next(at(1050)), 5);
}

// Of a host that is late all the time, and of encoders from a coarse one on.
TEST_F(SetpointStreamTest, IsLedThoughASyncIsLeftOutWheneverThatMayBe) {
  const trajectory::Polynomial curve{{0.0, 0.0, 0.0, 10.0, -15.0, 6.0}};
  const trajectory::Path path({{GoalTime{0.0}, GoalTime{1.0}, curve}});
  for (const double finer : {10.0, 30.0, 1000.0}) {
    SetpointStream one(encoding_of(kCounts * finer), limits());
    one.follow(path, at(1000));
    double worst = 0.0;
    int left_out = 0;
    for (int sync = 950; sync < 2400; sync += 10) {
      const std::int32_t target = *one.next(at(sync));
      const double wanted = path.sample(GoalTime{(sync + 10 - 1000) * 1e-3}).position;
      worst = std::max(worst, std::abs(target / (finer * kCounts) - wanted));
      if (!one.is_led()) continue;
      one.leave_out(at(sync), at(sync));
      ++left_out;
    }
    EXPECT_LE(worst, 0.02) << finer << ": of a radian";
    EXPECT_GE(left_out, 3) << finer;
    EXPECT_FALSE(one.astray()) << finer;
    EXPECT_EQ(one.newest_counts(), std::lround(finer * kCounts)) << finer;
  }
}

/// A target position and the instant at which it is reached, s.
struct Played {
  double stamp = 0.0;
  double position = 0.0;
};

/// Through the target positions n-3..n, each with its stamp (Lagrange).
double through_four(const std::vector<Played>& played, std::size_t n, double when) {
  double sum = 0.0;
  for (std::size_t i = n - 3; i <= n; ++i) {
    double term = played[i].position;
    for (std::size_t j = n - 3; j <= n; ++j)
      if (i != j) term *= (when - played[j].stamp) / (played[i].stamp - played[j].stamp);
    sum += term;
  }
  return sum;
}

/// Largest second difference over 1 ms, per s^2.
double acceleration_of(const std::vector<double>& demand) {
  double worst = 0.0;
  for (std::size_t i = 2; i < demand.size(); ++i)
    worst = std::max(worst, std::abs(demand[i] - 2.0 * demand[i - 1] + demand[i - 2]) / 1e-6);
  return worst;
}

/// Of a drive's demand: each target position takes effect 10 ms before its stamp, and stays in effect until
/// the next one does.
double executed_acceleration(const std::vector<Played>& played) {
  std::vector<double> demand;
  for (std::size_t n = 3; n + 1 < played.size(); ++n) {
    const auto samples = std::lround((played[n + 1].stamp - played[n].stamp) * 1e3);
    for (long i = 0; i < samples; ++i)
      demand.push_back(through_four(played, n, played[n].stamp - 0.01 + static_cast<double>(i) * 1e-3));
  }
  return acceleration_of(demand);
}

/// Of a drive that goes on along what it has for as long as it cannot be led, until the second period behind
/// its newest target position.
double acceleration_of_going_on(const std::vector<Played>& played) {
  std::vector<double> demand;
  const std::size_t n = played.size() - 1;
  for (int ms = -10; ms <= 20; ++ms) demand.push_back(through_four(played, n, played[n].stamp + ms * 1e-3));
  return acceleration_of(demand);
}

// From rest to rest at 0.9 of the limit of acceleration, in a third of a second. SYNCs are left out anywhere,
// of an encoder so fine that whole counts are nothing.
TEST_F(SetpointStreamTest, TheWayBackIsWithinTheLimitAsTheDriveExecutesIt) {
  constexpr double kFiner = 1e5;
  encoding::SetpointEncoding encoding = encoding_of(kCounts * kFiner);
  encoding.max_acceleration = 1.2 * kMaxAcceleration;
  constexpr double kReach = 0.171;
  const double d = 1.0 / 3.0;
  const trajectory::Polynomial curve{{0.0, 0.0, 0.0, 10.0 * kReach / (d * d * d),
                                      -15.0 * kReach / (d * d * d * d), 6.0 * kReach / (d * d * d * d * d)}};
  const trajectory::Path path({{GoalTime{0.0}, GoalTime{d}, curve}});
  for (int left_out = 1000; left_out < 1380; left_out += 10) {
    SetpointStream exact(encoding, limits());
    exact.follow(path, at(1000));
    std::vector<Played> played;
    double going_on = 0.0;
    for (int sync = 940; sync < 1700; sync += 10) {
      const double position = *exact.next(at(sync)) / (kCounts * kFiner);
      if (sync != left_out) {
        played.push_back({(sync + 10) * 1e-3, position});
      } else {
        exact.leave_out(at(sync), at(sync));
        going_on = acceleration_of_going_on(played);
      }
    }
    EXPECT_FALSE(exact.astray()) << left_out;
    EXPECT_LE(executed_acceleration(played), std::max(encoding.max_acceleration, going_on + 1e-3))
        << left_out;
    EXPECT_NEAR(played.back().position, kReach, 1e-7) << left_out;
  }
}

}  // namespace
}  // namespace interpolated_motion::axis
