#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/setpoint_streaming.h"

// Setpoints followed by drives that play from a FIFO: what has not been sent yet is encoded anew with each of
// them.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

struct Arm {
  const char* name;
  YAML::Node (*parameters)(const std::string& changes);
  double lead;             ///< s that the drives of the arm know ahead, see docs/setpoints.md
  double deviation;        ///< counts, of the demand from the path, at every sample
  double with_own_clocks;  ///< counts, the same where the drives' clocks are not the host's: bounds may be
                           ///< doubled
  double duration;         ///< s, of the long streams
  double acceleration;     ///< rad/s^2, of the demand, beyond the limit: by rounding (EPOS), by the bound
                           ///< (SilverLode)
};

std::ostream& operator<<(std::ostream& out, const Arm& arm) { return out << arm.name; }

class BufferedStream : public SetpointStreaming, public testing::WithParamInterface<Arm> {
 protected:
  void SetUp() override { start_with(""); }

  void start_with(const std::string& changes) {
    start(GetParam().parameters(changes), 0.03 + GetParam().lead);
  }

  double worst_deviation() {
    double worst = 0.0;
    for (const auto& joint : report().joints) worst = std::max(worst, joint.worst_deviation);
    return worst;
  }

  std::uint64_t underruns() {
    std::uint64_t sum = 0;
    for (const auto& joint : scenario->snapshot().joints) sum += joint.underruns;
    return sum;
  }

  double worst_acceleration() const {
    double worst = 0.0;
    for (const Smoothness& joint : smoothness) worst = std::max(worst, joint.acceleration);
    return worst;
  }

  void print(const std::string& what) {
    double step = 0.0;
    for (const Smoothness& joint : smoothness) step = std::max(step, joint.velocity_step);
    std::cout << fmt::format(
        "{}, {}: at most {:.2f} counts from the path, velocity step {:.4f} rad/s, acceleration {:.1f} "
        "rad/s^2\n",
        GetParam().name, what, worst_deviation(), step, worst_acceleration());
  }
};

TEST_P(BufferedStream, RegularSetpointsAreFollowedAtTheDelay) {
  stream(10.0, [](int) { return 0.001; });
  ASSERT_EQ(scenario->state(), GroupState::Streaming) << scenario->snapshot().fault;
  const double time = seconds(scenario->now() - begin);
  std::vector<trajectory::State> desired;
  ASSERT_TRUE(scenario->driver().query(scenario->now(), desired));
  for (const auto& joint : desired)
    EXPECT_NEAR(joint.position, position_at(time - 0.03 - GetParam().lead), 5e-3);
  print("50 Hz");
  EXPECT_LE(worst_deviation(), GetParam().deviation);
  EXPECT_LE(worst_acceleration(), kAcceleration + GetParam().acceleration);
  EXPECT_EQ(underruns(), 0U);
}

TEST_P(BufferedStream, LossAndJitterStayWithinTheLimitsWithoutAStop) {
  stream(GetParam().duration, with_loss(0.2, 5));
  EXPECT_EQ(scenario->state(), GroupState::Streaming) << scenario->snapshot().fault;
  print("20 % of 50 Hz lost, half a period of jitter");
  EXPECT_LE(worst_deviation(), GetParam().deviation);
  EXPECT_LE(worst_acceleration(), kAcceleration + GetParam().acceleration);
  EXPECT_EQ(underruns(), 0U);
}

TEST_P(BufferedStream, ComesToRestByItselfWhereTheStopLeads) {
  stream(1.25 + kPeriod / 2, [](int) { return 0.001; });  // the sine is fastest here
  const double t = kPeriod * 62;
  run(4.0);
  EXPECT_EQ(scenario->state(), GroupState::Idle) << scenario->snapshot().fault;
  const double v = velocity_at(t);
  // To the last setpoint, 0.1 s of riding through, and 0.75 v^2 / a; the velocity is estimated from
  // setpoints: the parabola's error is T^2 / 3 of the third derivative.
  const double dv = kPeriod * kPeriod / 3.0 * kAmplitude * std::pow(2.0 * 3.14159265, 3);
  const double predicted = position_at(t) + 0.1 * v + 0.75 * v * v / kAcceleration;
  for (const double position : scenario->positions())
    EXPECT_NEAR(position, predicted, dv * (0.1 + 1.5 * v / kAcceleration) + 1e-3);
  EXPECT_LE(worst_deviation(), GetParam().deviation);
  EXPECT_EQ(underruns(), 0U);
}

TEST_P(BufferedStream, GoesOnAfterAPauseAndBeginsAnewAfterItsEnd) {
  stream(1.3, [](int) { return 0.001; });
  run(0.9);  // at rest by now, and lingering
  EXPECT_EQ(scenario->state(), GroupState::Streaming);
  const double rest = scenario->positions()[2];
  EXPECT_FALSE(send(setpoint(scenario->now(), rest + 0.01)));
  run(4.0);
  EXPECT_EQ(scenario->state(), GroupState::Idle) << scenario->snapshot().fault;
  EXPECT_NEAR(scenario->positions()[2], rest + 0.01, 1e-3);
  EXPECT_FALSE(send(setpoint(scenario->now(), rest + 0.02)));
  run(4.0);
  EXPECT_EQ(scenario->state(), GroupState::Idle) << scenario->snapshot().fault;
  EXPECT_NEAR(scenario->positions()[2], rest + 0.02, 1e-3);
}

TEST_P(BufferedStream, HandsOverToAGoalAndBackWithinTheLimits) {
  stream(1.3, [](int) { return 0.001; });
  const auto accepted = scenario->submit(make_goal({1.5}, {{0.3, 0.3, 0.3, 0.3, 0.3, 0.3}}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_EQ(scenario->result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
  EXPECT_NEAR(scenario->positions()[2], 0.3, 1e-3);
  const auto after = send(setpoint(scenario->now(), 0.31));
  EXPECT_FALSE(after) << after->text;
  run(4.0);
  EXPECT_EQ(scenario->state(), GroupState::Idle) << scenario->snapshot().fault;
  EXPECT_NEAR(scenario->positions()[2], 0.31, 1e-3);
}

TEST_P(BufferedStream, StaysTogetherOnDrivesWithOtherClocks) {
  const bool has_can = std::string(GetParam().name) != "silverlode";
  start_with(std::string(has_can ? "{buses: {can0: {clock_discipline: false}}, " : "{") +
             "drives: {joint1: {emulation: {clock_error_ppm: 300}}, "
             "joint6: {emulation: {clock_error_ppm: -300}}}}");
  stream(GetParam().duration, with_loss(0.2, 7));
  ASSERT_EQ(scenario->state(), GroupState::Streaming) << scenario->snapshot().fault;
  std::vector<trajectory::State> desired;
  ASSERT_TRUE(scenario->driver().query(scenario->now(), desired));
  // Without correction the joints would be 0.6 ms per second apart. What is left: the uncertainty of two
  // clocks, a sample each, and what is made good in seconds.
  EXPECT_NEAR(desired[0].position, desired[5].position, 0.005 * kAmplitude * 2.0 * 3.1416);
  EXPECT_LE(worst_deviation(), GetParam().with_own_clocks);
  EXPECT_EQ(underruns(), 0U);
}

// Without a bound of its own the stream comes to more than 32 counts at places, see docs/setpoints.md.
TEST_F(SetpointStreaming, WhatNeedsMoreThanTheStreamsBoundIsRefused) {
  std::string drives;
  for (int i = 1; i <= 6; ++i) drives += fmt::format("joint{}: {{stream_deviation_bound: 32}}, ", i);
  start(six_axis_silverlode("{drives: {" + drives + "}}"), 0.274);
  std::string refusal;
  for (int k = 0; k < 500; ++k) {
    if (const auto why = send(setpoint(scenario->now(), position_at(k * kPeriod)))) refusal = why->text;
    run(kPeriod);
  }
  for (const char* part : {"Joint 'joint", "counts", "32"})
    EXPECT_NE(refusal.find(part), std::string::npos) << refusal;
  EXPECT_EQ(scenario->state(), GroupState::Streaming) << scenario->snapshot().fault;
  for (const auto& joint : report().joints) EXPECT_LE(joint.worst_deviation, 32.0);
}

// Lost setpoints, with and without going on at the velocity of the newest one.
TEST_F(SetpointStreaming, WithoutRidingThroughEposDrivesBrakeAtEveryGap) {
  const auto slowest = [this] {
    double least = 1e9;
    for (const Smoothness& joint : smoothness) least = std::min(least, joint.slowest);
    return least;
  };
  start(six_axis(), 0.155);
  stream(20.0, with_loss(0.2, 11));
  const double with = slowest();
  start(six_axis("{setpoints: {ride_through: 0.0}}"), 0.155);
  stream(20.0, with_loss(0.2, 11));
  const double without = slowest();
  std::cout << fmt::format(
      "20 % of 50 Hz lost, where the sine moves at 1.13..1.26 rad/s: at least {:.2f} rad/s, without "
      "riding "
      "through {:.2f} rad/s\n",
      with, without);
  EXPECT_GT(with, 0.8);
  EXPECT_LT(without, 0.75 * with);
}

INSTANTIATE_TEST_SUITE_P(Arms, BufferedStream,
                         testing::Values(Arm{"epos", six_axis, 0.125, 1.0, 2.0, 60.0, 2.0},
                                         Arm{"silverlode", six_axis_silverlode, 0.244, 512.0, 512.0, 10.0,
                                             4.0},
                                         Arm{"mixed", six_axis_mixed, 0.244, 512.0, 512.0, 10.0, 4.0}),
                         [](const auto& arm) { return std::string(arm.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
