#include "interpolation/cip_interpolator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace interpolated_motion::interpolation {
namespace {

constexpr HostDuration kPeriod = std::chrono::milliseconds(20);

HostTime at(double ms) { return HostTime(host_duration(ms * 1e-3)); }
SystemTime stamp(double ms) { return SystemTime(host_duration(ms * 1e-3)); }

CipParameters settings(int order, int missed_updates = 3) {
  CipParameters parameters;
  parameters.order = order;
  parameters.period = kPeriod;
  parameters.missed_updates = missed_updates;
  parameters.deceleration = 50.0;
  return parameters;
}

double cubic(double t) { return 1 + 2 * t - 30 * t * t + 200 * t * t * t; }
double cubic_rate(double t) { return 2 - 60 * t + 600 * t * t; }

/// Commands of the cubic motion at `first`, `first` + 20, .. `last` ms, each arriving a period before its
/// stamp.
void feed_cubic(CipInterpolator& interpolator, int first, int last) {
  for (int ms = first; ms <= last; ms += 20) interpolator.push(stamp(ms), cubic(ms * 1e-3), at(ms - 20));
}

TEST(CipInterpolator, HoldsUntilTheFirstCommandComesIntoEffect) {
  CipInterpolator interpolator(settings(3));
  interpolator.reset(7.0);
  EXPECT_EQ(interpolator.sample(at(0)).value, 7.0);
  EXPECT_EQ(interpolator.state(at(0)), CipState::Holding);
  EXPECT_EQ(interpolator.push(stamp(60), 7.5, at(10)), CipPush::Pending);
  EXPECT_EQ(interpolator.sample(at(39.999999)).value, 7.0);
  EXPECT_EQ(interpolator.state(at(39.999999)), CipState::Holding);
  EXPECT_EQ(interpolator.state(at(40)), CipState::Interpolating);
  EXPECT_GT(interpolator.sample(at(41)).value, 7.0);
  EXPECT_NEAR(interpolator.sample(at(60)).value, 7.5, 1e-15);
}

// The rest before a motion counts as history, so the first segment starts as the table says for P-1 = P-2 =
// P-3: by hand for d = 0.6, T = 0.02: dP = dV = dA = d.
TEST(CipInterpolator, MotionStartsFromRest) {
  CipInterpolator interpolator(settings(3));
  interpolator.reset(0.0);
  interpolator.push(stamp(20), 0.6, at(0));
  EXPECT_NEAR(interpolator.sample(at(0)).first_derivative, 0.6 * (1 - 0.5 - 1.0 / 6) / 0.02, 1e-12);
  EXPECT_NEAR(interpolator.sample(at(10)).value, 0.6 * (0.5 / 3 + 0.125 + 0.125 / 6), 1e-14);
}

TEST(CipInterpolator, NothingIsAppliedBeforeT0) {
  CipInterpolator with(settings(3));
  CipInterpolator without(settings(3));
  feed_cubic(with, 20, 100);
  feed_cubic(without, 20, 100);
  EXPECT_EQ(with.push(stamp(120), 55.0, at(81)), CipPush::Pending);
  for (double t = 81; t < 100; t += 0.5) {
    EXPECT_EQ(with.sample(at(t)).value, without.sample(at(t)).value) << t << " ms";
    EXPECT_EQ(with.sample(at(t)).first_derivative, without.sample(at(t)).first_derivative);
  }
  EXPECT_EQ(with.last_step().value, 0.0);
  EXPECT_GT(std::abs(with.sample(at(101)).value - without.sample(at(101)).value), 0.1);
}

TEST(CipInterpolator, CubicMotionIsExactWithinAndBeyondTheCommands) {
  CipInterpolator interpolator(settings(3));
  feed_cubic(interpolator, 20, 200);
  for (double t = 180; t <= 260; t += 0.25) {
    const CipSample sample = interpolator.sample(at(t));
    EXPECT_NEAR(sample.value, cubic(t * 1e-3), 1e-12) << t << " ms";
    EXPECT_NEAR(sample.first_derivative, cubic_rate(t * 1e-3), 1e-9);
    EXPECT_EQ(interpolator.state(at(t)), t <= 200 ? CipState::Interpolating : CipState::Extrapolating);
  }
}

TEST(CipInterpolator, CubicMotionIsExactWithIrregularStamps) {
  CipInterpolator interpolator(settings(3));
  double now = 0;
  for (const double ms : {20.0, 43.0, 58.0, 81.0, 99.0, 123.0}) {
    interpolator.push(stamp(ms), cubic(ms * 1e-3), at(now));
    now = ms;
  }
  for (double t = 99; t <= 170; t += 0.25) {
    EXPECT_NEAR(interpolator.sample(at(t)).value, cubic(t * 1e-3), 1e-12) << t << " ms";
  }
}

TEST(CipInterpolator, QuadraticVelocityIsExact) {
  CipParameters parameters = settings(2);
  parameters.command = CipCommand::Velocity;
  CipInterpolator interpolator(parameters);
  for (int ms = 20; ms <= 200; ms += 20) {
    interpolator.push(stamp(ms), cubic_rate(ms * 1e-3), at(ms - 20));
  }
  for (double t = 180; t <= 250; t += 0.5) {
    EXPECT_NEAR(interpolator.sample(at(t)).value, cubic_rate(t * 1e-3), 1e-11) << t << " ms";
    EXPECT_NEAR(interpolator.sample(at(t)).first_derivative, -60 + 1200 * t * 1e-3, 1e-9);
  }
}

TEST(CipInterpolator, LinearAccelerationIsExact) {
  CipParameters parameters = settings(1);
  parameters.command = CipCommand::Acceleration;
  CipInterpolator interpolator(parameters);
  for (int ms = 20; ms <= 100; ms += 20) interpolator.push(stamp(ms), 5.0 - 0.1 * ms, at(ms - 20));
  for (double t = 80; t <= 150; t += 0.5) {
    EXPECT_NEAR(interpolator.sample(at(t)).value, 5.0 - 0.1 * t, 1e-12) << t << " ms";
  }
}

TEST(CipInterpolator, SystemTimeIsLocalTimePlusItsOffset) {
  CipInterpolator interpolator(settings(3));
  interpolator.set_system_time_offset({std::chrono::milliseconds(5000)});
  for (int ms = 20; ms <= 200; ms += 20) {
    interpolator.push(stamp(5000 + ms), cubic(ms * 1e-3), at(ms - 20));
  }
  EXPECT_NEAR(interpolator.sample(at(190)).value, cubic(0.190), 1e-12);
  interpolator.set_system_time_offset({std::chrono::milliseconds(5001)});
  EXPECT_NEAR(interpolator.sample(at(190)).value, cubic(0.191), 1e-12);
  const SystemTimeOffset offset{std::chrono::milliseconds(3)};
  EXPECT_EQ(offset.local(offset.system(at(1))), at(1));
}

// A late command is not thrown away: from its arrival on the output is that of an interpolator which had it
// in time, and what it steps by is told.
TEST(CipInterpolator, LateCommandIsAppliedAtOnce) {
  for (const double arrival : {100.0, 105.0, 133.0}) {
    CipInterpolator late(settings(2));
    CipInterpolator punctual(settings(2));
    feed_cubic(late, 20, 100);
    feed_cubic(punctual, 20, 120);
    const CipSample before = late.sample(at(arrival));
    EXPECT_EQ(late.push(stamp(120), cubic(0.120), at(arrival)), CipPush::Applied);
    for (double t = arrival; t < arrival + 5; t += 0.5) {
      EXPECT_EQ(late.sample(at(t)).value, punctual.sample(at(t)).value);
    }
    const CipSample after = late.sample(at(arrival));
    EXPECT_EQ(late.last_step().value, after.value - before.value);
    EXPECT_EQ(late.last_step().first_derivative, after.first_derivative - before.first_derivative);
  }
}

TEST(CipInterpolator, CommandsThatComeTogetherAreAllApplied) {
  CipInterpolator burst(settings(3, 6));
  CipInterpolator punctual(settings(3, 6));
  feed_cubic(burst, 20, 100);
  feed_cubic(punctual, 20, 180);
  for (const int ms : {120, 140, 160, 180}) burst.push(stamp(ms), cubic(ms * 1e-3), at(171));
  EXPECT_EQ(burst.sample(at(171)).value, punctual.sample(at(171)).value);
}

TEST(CipInterpolator, OvertakenCommandTakesItsPlaceInTheHistory) {
  CipInterpolator interpolator(settings(3));
  CipInterpolator in_order(settings(3));
  feed_cubic(interpolator, 20, 100);
  feed_cubic(in_order, 20, 100);
  EXPECT_EQ(interpolator.push(stamp(140), 9.0, at(110)), CipPush::Applied);
  EXPECT_EQ(interpolator.push(stamp(120), 8.0, at(111)), CipPush::Filled);
  in_order.push(stamp(120), 8.0, at(111));
  in_order.push(stamp(140), 9.0, at(111));
  for (double t = 111; t < 150; t += 1) {
    EXPECT_EQ(interpolator.sample(at(t)).value, in_order.sample(at(t)).value) << t << " ms";
  }
  EXPECT_EQ(interpolator.push(stamp(120), 1.0, at(151)), CipPush::Outdated);
  EXPECT_EQ(interpolator.push(stamp(-200), 1.0, at(151)), CipPush::Outdated);
}

TEST(CipInterpolator, EarlyCommandsWaitFourDeep) {
  CipInterpolator interpolator(settings(3));
  feed_cubic(interpolator, 20, 200);
  int pending = 0;
  for (int ms = 220; interpolator.push(stamp(ms), cubic(ms * 1e-3), at(190)) != CipPush::Full; ms += 20) {
    ++pending;
  }
  EXPECT_EQ(pending, 4);
  for (double t = 190; t <= 280; t += 1) {
    EXPECT_NEAR(interpolator.sample(at(t)).value, cubic(t * 1e-3), 1e-12) << t << " ms";
  }
  EXPECT_EQ(interpolator.push(stamp(300), cubic(0.3), at(210)), CipPush::Pending);
}

TEST(CipInterpolator, RidesThroughUpToTheLimitThenStops) {
  for (const int limit : {0, 1, 3}) {
    CipInterpolator interpolator(settings(1, limit));
    for (int ms = 20; ms <= 100; ms += 20) interpolator.push(stamp(ms), 0.05 * ms, at(ms - 20));
    const double begin = 100 + 20 * limit;
    EXPECT_NEAR(interpolator.sample(at(begin)).value, 0.05 * begin, 1e-12);
    EXPECT_NE(interpolator.state(at(begin)), CipState::Stopping);
    EXPECT_EQ(interpolator.extrapolated(at(begin)), host_duration(0.02 * limit));
    // 50 per s braked with 50 per s^2: 1 s and 25 on the way.
    EXPECT_EQ(interpolator.state(at(begin + 1)), CipState::Stopping);
    EXPECT_EQ(interpolator.push(stamp(begin + 20), 1.0, at(begin + 2)), CipPush::Stopped);
    EXPECT_NEAR(interpolator.sample(at(begin + 500)).value, 0.05 * begin + 18.75, 1e-10);
    EXPECT_NEAR(interpolator.sample(at(begin + 500)).first_derivative, 25.0, 1e-10);
    EXPECT_EQ(interpolator.sample(at(begin + 500)).second_derivative, -50.0);
    EXPECT_NEAR(interpolator.sample(at(begin + 1001)).value, 0.05 * begin + 25.0, 1e-10);
    EXPECT_EQ(interpolator.state(at(begin + 1001)), CipState::Stopped);
    interpolator.reset(3.0);
    EXPECT_EQ(interpolator.state(at(begin + 1001)), CipState::Holding);
    EXPECT_EQ(interpolator.sample(at(begin + 1001)).value, 3.0);
  }
}

// The stop begins at the limit itself, not at the first look after it, and never decelerates more than told.
TEST(CipInterpolator, StopDoesNotDependOnWhenItIsSeen) {
  CipInterpolator often(settings(3));
  CipInterpolator once(settings(3));
  feed_cubic(often, 20, 200);
  feed_cubic(once, 20, 200);
  double velocity = often.sample(at(260)).first_derivative;
  for (double t = 261; t < 2000; t += 1) {
    const double next = often.sample(at(t)).first_derivative;
    EXPECT_LE(std::abs(next - velocity), 50.0 * 1e-3 * (1 + 1e-9));
    velocity = next;
  }
  EXPECT_EQ(often.sample(at(2000)).value, once.sample(at(2000)).value);
  const double speed = cubic_rate(0.260);
  EXPECT_NEAR(once.sample(at(2000)).value, cubic(0.260) + speed * speed / 100.0, 1e-9);
}

TEST(CipInterpolator, VelocityStopsOnARampAndAccelerationAtOnce) {
  CipParameters parameters = settings(1, 1);
  parameters.command = CipCommand::Velocity;
  CipInterpolator velocity(parameters);
  parameters.command = CipCommand::Acceleration;
  CipInterpolator acceleration(parameters);
  for (int ms = 20; ms <= 100; ms += 20) {
    velocity.push(stamp(ms), -10.0, at(ms - 20));
    acceleration.push(stamp(ms), -10.0, at(ms - 20));
  }
  EXPECT_NEAR(velocity.sample(at(120)).value, -10.0, 1e-12);
  EXPECT_NEAR(velocity.sample(at(220)).value, -5.0, 1e-12);
  EXPECT_NEAR(velocity.sample(at(220)).first_derivative, 50.0, 1e-12);
  EXPECT_EQ(velocity.state(at(220)), CipState::Stopping);
  EXPECT_EQ(velocity.sample(at(321)).value, 0.0);
  EXPECT_EQ(velocity.state(at(321)), CipState::Stopped);
  EXPECT_EQ(acceleration.sample(at(121)).value, 0.0);
  EXPECT_EQ(acceleration.state(at(121)), CipState::Stopped);
}

TEST(CipInterpolator, FirstCommandBeyondTheLimitDoesNotMove) {
  CipInterpolator interpolator(settings(3, 2));
  interpolator.reset(4.0);
  EXPECT_EQ(interpolator.push(stamp(100), 5.0, at(141)), CipPush::Outdated);
  EXPECT_EQ(interpolator.sample(at(200)).value, 4.0);
  EXPECT_EQ(interpolator.state(at(200)), CipState::Holding);
}

// Position and velocity go on from where the extrapolation was; the correction stays within its bound and is
// gone when it should be.
TEST(CipInterpolator, BlendRemovesTheStepWithinItsBound) {
  CipParameters parameters = settings(2);
  parameters.blend = std::chrono::milliseconds(8);
  CipInterpolator blended(parameters);
  CipInterpolator plain(settings(2));
  feed_cubic(blended, 20, 100);
  feed_cubic(plain, 20, 100);
  const double arrival = 131;
  const CipSample before = blended.sample(at(arrival));
  blended.push(stamp(120), cubic(0.120) + 0.3, at(arrival));
  plain.push(stamp(120), cubic(0.120) + 0.3, at(arrival));
  const CipStep step = blended.last_step();
  EXPECT_GT(std::abs(step.value), 0.1);
  EXPECT_EQ(step.value, plain.last_step().value);
  EXPECT_NEAR(blended.sample(at(arrival)).value, before.value, 1e-14);
  EXPECT_NEAR(blended.sample(at(arrival)).first_derivative, before.first_derivative, 1e-12);
  const double bound = std::abs(step.value) + 4.0 / 27 * 0.008 * std::abs(step.first_derivative);
  double last = before.value;
  for (int tenth = 1; tenth < 80; ++tenth) {
    const double t = arrival + 0.1 * tenth;
    const CipSample sample = blended.sample(at(t));
    EXPECT_LE(std::abs(sample.value - plain.sample(at(t)).value), bound * (1 + 1e-12));
    // The rate is that of the values: central difference, its error h^2 / 24 of the third derivative.
    EXPECT_NEAR((sample.value - last) / 1e-4, blended.sample(at(t - 0.05)).first_derivative, 0.01);
    last = sample.value;
  }
  EXPECT_EQ(blended.sample(at(arrival + 8)).value, plain.sample(at(arrival + 8)).value);
}

TEST(CipInterpolator, WrongSettingsAreRefusedByName) {
  const auto refusal = [](CipParameters parameters) -> std::string {
    try {
      CipInterpolator interpolator(parameters);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(settings(3)), "");
  EXPECT_EQ(refusal(settings(4)), "fine interpolator: order is 4, allowed is 1..3");
  EXPECT_EQ(refusal(settings(0)), "fine interpolator: order is 0, allowed is 1..3");
  CipParameters parameters = settings(3);
  parameters.command = CipCommand::Velocity;
  EXPECT_EQ(refusal(parameters), "fine interpolator: order is 3, allowed is 1..2");
  parameters.command = CipCommand::Acceleration;
  EXPECT_EQ(refusal(parameters), "fine interpolator: order is 3, allowed is 1");
  EXPECT_EQ(refusal(settings(3, -1)), "fine interpolator: missed_updates is -1, allowed is 0..1000");
  parameters = settings(3);
  parameters.period = HostDuration::zero();
  EXPECT_EQ(refusal(parameters), "fine interpolator: period is 0, allowed is 1 ns or more");
  parameters = settings(3);
  parameters.deceleration = 0.0;
  EXPECT_EQ(refusal(parameters), "fine interpolator: deceleration is 0, allowed is a finite number above 0");
  parameters = settings(3);
  parameters.blend = HostDuration(-1);
  EXPECT_EQ(refusal(parameters), "fine interpolator: blend is -1, allowed is 0 ns or more");
}

}  // namespace
}  // namespace interpolated_motion::interpolation
