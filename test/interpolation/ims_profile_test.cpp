#include "interpolated_motion_driver/interpolation/ims_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace interpolated_motion::interpolation {
namespace {

/// The worked example of QCI-TD044, its last segment included.
const std::vector<ImsSegment> kWorkedExample{{4000, 1073741824, 1073742, 536870912},
                                             {3000, 1073741824, 1073742, 1073741824},
                                             {1000, 1073741824, 1073742, 536870912},
                                             {2000, 92000, 536871, 536870912}};

std::vector<double> marks_of(const std::vector<ImsSegment>& segments, const ImsScale& scale) {
  ImsProfile profile(scale, ims_at_rest(scale, 0));
  std::vector<double> marks;
  for (const ImsSegment& segment : segments) {
    profile.load(segment);
    for (std::int32_t i = 0; i < segment.time; ++i) profile.tick();
    marks.push_back(ims_counts(scale, profile.state()));
  }
  return marks;
}

TEST(ImsProfile, WorkedExampleOfTheDocument) {
  // v^2 / 2a and v t with v = 8 and 16 counts/tick and a = 0.008 counts/tick^2; 1073742 is 0.3 ppm off that.
  const auto marks = marks_of(kWorkedExample, ImsScale{});
  EXPECT_NEAR(marks[0], 28000, 0.02);
  EXPECT_NEAR(marks[1], 72000, 0.02);
  EXPECT_NEAR(marks[2], 84000, 0.02);
  EXPECT_DOUBLE_EQ(marks[3], 92000.0);
}

TEST(ImsProfile, WorkedExampleEndsTheSameWhicheverIsUpdatedFirst) {
  for (const double lag : {0.0, 1.0}) {
    ImsScale scale;
    scale.position_lag = lag;
    const auto marks = marks_of(kWorkedExample, scale);
    const double sign = lag == 0.0 ? 1.0 : -1.0;  // half a tick early or late, at 8, 16 and 8 counts/tick
    EXPECT_NEAR(marks[0], 28000 + sign * 4, 0.02);
    EXPECT_NEAR(marks[1], 72000 + sign * 8, 0.02);
    EXPECT_NEAR(marks[2], 84000 + sign * 4, 0.02);
    EXPECT_DOUBLE_EQ(marks[3], 92000.0);
  }
}

TEST(ImsProfile, OtherEncodersScaleTheSameMotion) {
  ImsScale scale;
  scale.counts_per_revolution = 8192;
  auto segments = kWorkedExample;
  segments.back().position = 188416;  // 92000 * 8192 / 4000
  EXPECT_DOUBLE_EQ(marks_of(segments, scale).back(), 188416.0);
}

TEST(ImsProfile, OneCountPerTickIs2To26Units) {
  EXPECT_DOUBLE_EQ(ImsScale{}.units_per_count(), 67108864.0);
  EXPECT_EQ(ImsScale{}.acceleration_per_step(), 2);
}

TEST(ImsProfile, AnOddAccelerationLosesItsFraction) {
  const ImsScale scale;
  ImsProfile profile(scale, ims_at_rest(scale, 0));
  profile.load({100, 1 << 30, 7, 1000});
  profile.tick();
  profile.tick();
  EXPECT_EQ(profile.state(), (ImsState{9, 6}));  // 3 + 6
}

TEST(ImsProfile, AccelerationZeroKeepsTheVelocity) {
  const ImsScale scale;
  ImsProfile profile(scale, {0, -12345});
  profile.load({3, -(1 << 30), 0, 99});
  for (int i = 0; i < 3; ++i) profile.tick();
  EXPECT_EQ(profile.state(), (ImsState{-37035, -12345}));
}

TEST(ImsProfile, DirectionWrapsAround) {
  const ImsScale scale;
  ImsProfile profile(scale, ims_at_rest(scale, std::numeric_limits<std::int32_t>::max() - 10));
  // 2^30 counts ahead, beyond the register's end.
  profile.load({100, ims_register(std::int64_t{2147483637} + (1 << 30)), 1 << 20, 1 << 28});
  for (int i = 0; i < 100; ++i) profile.tick();
  EXPECT_GT(profile.state().velocity, 0);
  EXPECT_GT(ims_counts(scale, profile.state()), 2147483637.0);
}

TEST(ImsProfile, LandsExactlyAcrossTheRegistersEnd) {
  const ImsScale scale;
  ImsProfile profile(scale, ims_at_rest(scale, 2147483000));
  profile.load({4000, ims_register(2147484000), 1 << 22, 1 << 26});
  for (int i = 0; i < 4000; ++i) profile.tick();
  EXPECT_EQ(profile.state(), ims_at_rest(scale, 2147484000));
}

TEST(ImsProfile, ReturnsToTheCountItStandsNextTo) {
  const ImsScale scale;
  ImsProfile profile(scale, {ims_at_rest(scale, 10).sum + (1 << 24), 0});  // 10.25 counts
  profile.load({1000, 10, 1 << 8, 1 << 20});
  profile.tick();
  EXPECT_EQ(profile.state().velocity, -(1 << 7));
  for (int i = 1; i < 1000; ++i) profile.tick();
  EXPECT_EQ(profile.state(), ims_at_rest(scale, 10));
}

TEST(ImsProfile, NeverPassesItsPosition) {
  const ImsScale scale;
  ImsProfile profile(scale, {0, 1 << 26});  // 1 count per tick; 2^20 units a tick need 32 counts to stop
  profile.load({1000, 10, 1 << 21, 1 << 26});
  for (int i = 0; i < 1000; ++i) {
    profile.tick();
    ASSERT_LE(profile.state().sum, ims_at_rest(scale, 10).sum);
  }
  EXPECT_EQ(profile.state(), ims_at_rest(scale, 10));
}

std::int64_t uniform(std::mt19937_64& engine, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(engine() % static_cast<std::uint64_t>(high - low + 1));
}

/// A magnitude of random size.
std::int64_t any_size(std::mt19937_64& engine, int bits) {
  return uniform(engine, 0, (std::int64_t{1} << uniform(engine, 1, bits)) - 1);
}

TEST(ImsProfile, ClosedFormAgreesWithTheTicksWhereTheSegmentRunsFree) {
  std::mt19937_64 engine(120);
  const ImsScale scale;
  int free = 0;
  for (int n = 0; n < 2000; ++n) {
    const std::int64_t sign = uniform(engine, 0, 1) == 0 ? 1 : -1;
    const ImsState from{uniform(engine, -(1LL << 56), 1LL << 56), sign * any_size(engine, 31)};
    const auto time = static_cast<std::int32_t>(uniform(engine, 1, 3000));
    const ImsSegment segment{time, ims_register(ims_nearest_count(scale, from) + sign * (1 << 30)),
                             static_cast<std::int32_t>(any_size(engine, 30)),
                             static_cast<std::int32_t>(any_size(engine, 31))};
    ImsProfile profile(scale, from);
    profile.load(segment);
    if (!profile.runs_free(time)) continue;
    ++free;
    for (std::int64_t i = 1; i <= time; ++i) {
      profile.tick();
      ASSERT_EQ(profile.state(), ramp_and_hold(from, sign * segment.velocity, segment.acceleration / 2, i))
          << "case " << n << " tick " << i;
    }
  }
  EXPECT_GT(free, 1000);
}

TEST(ImsProfile, LandsExactlyFromAnyVelocityWithRoomToBrake) {
  std::mt19937_64 engine(7);
  const ImsScale scale;
  for (int n = 0; n < 500; ++n) {
    const std::int64_t sign = uniform(engine, 0, 1) == 0 ? 1 : -1;
    const std::int64_t velocity = uniform(engine, 1, 1 << 28);
    const std::int64_t acceleration = uniform(engine, 1 << 17, 1 << 24);
    const std::int64_t count = uniform(engine, -1000000, 1000000);
    // Braking needs v^2 / 2a; up to 300 counts more than that.
    const double step = static_cast<double>(acceleration) / 2;
    const double stop = static_cast<double>(velocity) * static_cast<double>(velocity) / (2 * step);
    const auto room = static_cast<std::int64_t>(stop) + velocity + any_size(engine, 34);
    const ImsState from{ims_at_rest(scale, count).sum - sign * room, sign * velocity};
    ImsProfile profile(scale, from);
    profile.load({1, static_cast<std::int32_t>(count), static_cast<std::int32_t>(acceleration),
                  static_cast<std::int32_t>(velocity)});
    int ticks = 0;
    while (profile.state().velocity != 0 && ticks < 2000000) {
      profile.tick();
      ++ticks;
      ASSERT_LE(sign * profile.state().velocity, velocity);
    }
    ASSERT_EQ(profile.state(), ims_at_rest(scale, count)) << "case " << n;
  }
}

TEST(ImsProfile, GreatestLandingVelocityIsTheInverseOfTheStoppingSum) {
  std::mt19937_64 engine(11);
  for (int n = 0; n < 20000; ++n) {
    const std::int64_t distance = any_size(engine, 57);
    const std::int64_t step = 1 + any_size(engine, 29);
    const std::int64_t velocity = greatest_landing_velocity(distance, step);
    if (velocity >= (1LL << 31)) continue;
    ASSERT_LE(stopping_sum(velocity, step), distance);
    ASSERT_GT(stopping_sum(velocity + 1, step), distance);
  }
}

TEST(ImsProfile, StoppingSumAddsUpTheTicks) {
  for (const std::int64_t velocity : {1, 5, 10, 11, 99}) {
    for (const std::int64_t step : {1, 2, 5, 10, 200}) {
      std::int64_t sum = 0;
      for (std::int64_t v = velocity; v > 0; v -= step) sum += v;
      EXPECT_EQ(stopping_sum(velocity, step), sum) << velocity << " by " << step;
    }
  }
}

TEST(ImsScale, ValidationNamesParameterValueAndRange) {
  EXPECT_NO_THROW(ImsScale{}.validate());
  ImsScale scale;
  scale.acceleration_full_scale_rpm_per_tick = 4000;
  EXPECT_NO_THROW(scale.validate());
  scale.acceleration_full_scale_rpm_per_tick = 3000;
  try {
    scale.validate();
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()),
              "IMS scale: acceleration_full_scale_rpm_per_tick is 3000, allowed is velocity_full_scale_rpm "
              "divided by a whole number.");
  }
  for (double ImsScale::*parameter :
       {&ImsScale::counts_per_revolution, &ImsScale::velocity_full_scale_rpm, &ImsScale::tick}) {
    for (const double value : {0.0, -1.0, std::nan(""), 1e30}) {
      scale = ImsScale{};
      scale.*parameter = value;
      EXPECT_THROW(scale.validate(), std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace interpolated_motion::interpolation
