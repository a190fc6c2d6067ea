#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "hardware/setpoint_streaming.h"

// Setpoints at a coarse and irregular rate, followed by six cyclic drives.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr double kPi = 3.14159265358979324;

constexpr double kDelay = 0.060;  // s: three SYNC periods, and setpoints/delay

class CyclicStream : public SetpointStreaming {
 protected:
  void SetUp() override { start(six_axis_cyclic(), kDelay); }

  /// Desired velocity of the arm each ms, and how it changes.
  void look() override {
    const auto snapshot = scenario->snapshot();
    if (begin == HostTime{} || snapshot.state != GroupState::Streaming) return;
    const auto& joint = snapshot.joints[2];
    const double velocity = joint.desired.velocity;
    if (seen) worst_acceleration = std::max(worst_acceleration, std::abs(velocity - *seen) / kSync);
    if (joint.desired.position != seen_position) seen = velocity;
    seen_position = joint.desired.position;
    const double t = seconds(scenario->now() - begin) - kDelay;
    if (t > 0.2) worst_error = std::max(worst_error, std::abs(joint.actual.position - position_at(t)));
  }

  static constexpr double kSync = 0.010;  // feedback, and so `desired`, is of the last SYNC

  std::optional<double> seen;
  double seen_position = 0.0;
  double worst_acceleration = 0.0;
  double worst_error = 0.0;
};

TEST_F(CyclicStream, RegularStreamIsFollowedAtItsDelay) {
  stream(3.0, [](int) { return 0.001; });
  EXPECT_EQ(scenario->state(), GroupState::Streaming);
  // Feedback is up to a SYNC period and a millisecond old, at 1.26 rad/s; beyond that, the curve between
  // setpoints.
  EXPECT_LE(worst_error, kAmplitude * 2.0 * kPi * 0.012 + 0.003);
  EXPECT_EQ(scenario->snapshot().setpoints.accepted, 150U);
}

TEST_F(CyclicStream, LossAndJitterStayWithinTheLimitsWithoutAStop) {
  stream(30.0, with_loss(0.2, 5));
  EXPECT_EQ(scenario->state(), GroupState::Streaming);
  const auto snapshot = scenario->snapshot();
  EXPECT_GT(snapshot.setpoints.accepted, 1000U);
  EXPECT_LT(snapshot.setpoints.accepted, 1300U);
  EXPECT_EQ(snapshot.setpoints.refused, 0U);
  EXPECT_EQ(snapshot.joints[0].underruns, 0U);
  EXPECT_LE(worst_acceleration, 1.05 * kAcceleration);
  std::cout << "20 % of 50 Hz lost, jitter of half a period: worst error " << worst_error
            << " rad behind the delay, worst change of velocity " << worst_acceleration << " rad/s^2\n";
}

// The fine interpolation makes velocity steps of steps in acceleration: at every servo sample.
TEST_F(CyclicStream, WhatTheDrivesInterpolateKeepsTheLimitOfAcceleration) {
  stream(20.0, with_loss(0.2, 5));
  run(2.5);
  EXPECT_EQ(scenario->state(), GroupState::Idle);
  double worst = 0.0;
  for (const Smoothness& joint : smoothness) worst = std::max(worst, joint.acceleration);
  std::cout << "20 % of 50 Hz lost, jitter of half a period: the drives interpolate " << worst
            << " rad/s^2 at most\n";
  // limit_margin, and whole counts: 8 of them over three periods where two cubics meet, 2 in a period
  // squared.
  constexpr double kCount = 2.0 * kPi / 200000.0;
  const double rounding = 8.0 * kCount / (3.0 * kSync * 1e-3) + 2.0 * kCount / (kSync * kSync);
  EXPECT_LE(worst, 1.2 * kAcceleration + rounding);
}

TEST_F(CyclicStream, EndsInMotionAtRestWithinTheDistancePredicted) {
  stream(1.25 + kPeriod / 2, [](int) { return 0.001; });  // the sine is fastest here
  const double t = 0.02 * 62;
  run(2.5);
  EXPECT_EQ(scenario->state(), GroupState::Idle);
  const double v = velocity_at(t);
  // To the last setpoint, 0.1 s of riding through, and 0.75 v^2 / a; the velocity is estimated from
  // setpoints: the parabola's error is T^2 / 3 of the third derivative.
  const double dv = kPeriod * kPeriod / 3.0 * kAmplitude * std::pow(2.0 * kPi, 3);
  const double predicted = position_at(t) + 0.1 * v + 0.75 * v * v / kAcceleration;
  EXPECT_NEAR(scenario->positions()[2], predicted, dv * (0.1 + 1.5 * v / kAcceleration) + 1e-3);
}

TEST_F(CyclicStream, HandsOverToAGoalAndBackWithoutAJump) {
  stream(1.3, [](int) { return 0.001; });
  const auto accepted = scenario->submit(make_goal({1.5}, {{0.3, 0.3, 0.3, 0.3, 0.3, 0.3}}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  double before = scenario->positions()[2];
  double step = 0.0;
  scenario->run_until(
      [&] {
        const double position = scenario->positions()[2];
        step = std::max(step, std::abs(position - before));
        before = position;
        return scenario->state() == GroupState::Moving;
      },
      3.0);
  EXPECT_LE(step, 1.5 * kSync);  // no more than a SYNC period at 1.5 rad/s
  const auto during = send(setpoint(scenario->now(), 0.0));
  ASSERT_TRUE(during);
  EXPECT_NE(during->text.find("goal is under way"), std::string::npos) << during->text;
  EXPECT_EQ(scenario->result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
  EXPECT_NEAR(scenario->positions()[2], 0.3, 1e-3);
  const auto after = send(setpoint(scenario->now(), 0.31));
  EXPECT_FALSE(after) << after->text;
  EXPECT_EQ(scenario->state(), GroupState::Streaming);
  scenario->run(2.5);
  EXPECT_EQ(scenario->state(), GroupState::Idle);
  EXPECT_NEAR(scenario->positions()[2], 0.31, 1e-4);
}

TEST_F(CyclicStream, HaltStopsTheStream) {
  stream(1.3, [](int) { return 0.001; });
  const auto id = scenario->driver().halt(scenario->now());
  EXPECT_TRUE(scenario->result_of_request(id, 1.0).success);
  EXPECT_EQ(scenario->state(), GroupState::Idle);
}

TEST_F(CyclicStream, FaultOfADriveStopsTheStream) {
  stream(1.3, [](int) { return 0.001; });
  std::string reason;
  ASSERT_TRUE(scenario->driver().inject("joint3", "emcy 0x2310", &reason, scenario->now())) << reason;
  EXPECT_TRUE(scenario->run_until_state(GroupState::Fault, 2.0));
  const auto refusal = send(setpoint(scenario->now(), 0.0));
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->text.find("0x2310"), std::string::npos) << refusal->text;
}

class BadSetpoint : public SetpointStreaming {
 protected:
  void SetUp() override {
    start(six_axis_cyclic(), kDelay);
    stream(0.5, [](int) { return 0.001; });
  }

  void expect_refused(const motion::Setpoint& s, const char* part) {
    const auto paths = scenario->snapshot();
    const auto refusal = send(s);
    ASSERT_TRUE(refusal) << "was accepted; expected: " << part;
    EXPECT_NE(refusal->text.find(part), std::string::npos) << refusal->text;
    EXPECT_EQ(scenario->snapshot().setpoints.refused, paths.setpoints.refused + 1);
    EXPECT_EQ(scenario->state(), GroupState::Streaming);
  }

  motion::Setpoint good() { return setpoint(scenario->now(), position_at(seconds(scenario->now() - begin))); }
};

TEST_F(BadSetpoint, IsRefusedAndTheStreamGoesOn) {
  auto s = good();
  s.time = begin + host_duration(0.3);
  expect_refused(s, "out of order");
  s = good();
  s.time += host_duration(0.6);
  expect_refused(s, "too far ahead");
  s = good();
  s.positions[4] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(s, "position of joint \"joint5\" in the setpoint is nan");
  s = good();
  s.velocities.assign(6, std::numeric_limits<double>::infinity());
  expect_refused(s, "velocity of joint \"joint1\" in the setpoint is inf");
  s = good();
  s.positions.pop_back();
  expect_refused(s, "5 positions");
  s = good();
  s.joint_names[0] = "joint2";
  expect_refused(s, "joint1");
  s = good();
  s.source = "/servo";
  expect_refused(s, "/servo");
  s = good();
  s.positions[1] += 2.0;
  expect_refused(s, "joint2");
  s = good();
  s.positions.assign(6, 4.0);
  expect_refused(s, "position");
  const auto refusal = send(good());
  EXPECT_FALSE(refusal) << refusal->text;
}

TEST_F(BadSetpoint, OldOneIsRefused) {
  run(2.5);
  ASSERT_EQ(scenario->state(), GroupState::Idle);
  const auto refusal = send(setpoint(scenario->now() - std::chrono::milliseconds(300), 0.2));
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->text.find("past"), std::string::npos) << refusal->text;
  EXPECT_EQ(scenario->state(), GroupState::Idle);
}

TEST_F(SetpointStreaming, AllKindsOfDrivesFollowTogether) {
  start(six_axis_of_all_kinds(), 0.33);
  stream(5.0, with_loss(0.2, 3));
  ASSERT_EQ(scenario->state(), GroupState::Streaming) << scenario->snapshot().fault;
  run(4.0);
  ASSERT_EQ(scenario->state(), GroupState::Idle) << scenario->snapshot().fault;
  for (const double position : scenario->positions()) EXPECT_NEAR(position, scenario->positions()[0], 1e-3);
}

}  // namespace
}  // namespace interpolated_motion::test
