#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/scenario.h"

// Setpoints at a coarse and irregular rate, followed by six cyclic drives.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr double kPi = 3.14159265358979324;
constexpr double kPeriod = 0.020;       // s, of the setpoints
constexpr double kAmplitude = 0.2;      // rad
constexpr double kAcceleration = 20.0;  // rad/s^2, limit
const double kCounts = 100.0 * 2000.0 / (2.0 * kPi);

/// 1 Hz, from rest at 0: its velocity is that of the sine from the first moment on, so it starts at a crest.
double crest(double t) { return kAmplitude * (1.0 - std::cos(2.0 * kPi * t)); }
double crest_velocity(double t) { return kAmplitude * 2.0 * kPi * std::sin(2.0 * kPi * t); }

motion::Setpoint setpoint(HostTime time, double position) {
  motion::Setpoint s;
  s.time = time;
  s.source = "/joystick";
  for (int i = 1; i <= 6; ++i) {
    s.joint_names.push_back(fmt::format("joint{}", i));
    s.positions.push_back(position);
  }
  return s;
}

class SetpointStreaming : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
    scenario.driver().set_sample_observer({});
  }

  std::optional<Refusal> send(const motion::Setpoint& s) {
    return scenario.driver().setpoint(s, scenario.now());
  }

  /// Streams the sine for `duration`; `arrives(k)` tells how late setpoint k comes, s, negative: never.
  void stream(double duration, const std::function<double(int)>& arrives) {
    begin = scenario.now();
    const int count = static_cast<int>(std::lround(duration / kPeriod));
    std::vector<std::pair<double, int>> order;
    for (int k = 0; k < count; ++k)
      if (arrives(k) >= 0.0) order.emplace_back(k * kPeriod + arrives(k), k);
    std::sort(order.begin(), order.end());
    for (const auto& [when, k] : order) {
      run_to(begin + host_duration(when));
      const auto refusal = send(setpoint(begin + host_duration(k * kPeriod), crest(k * kPeriod)));
      EXPECT_FALSE(refusal) << refusal->text;
    }
  }

  void run_to(HostTime when) {
    while (scenario.now() < when) {
      scenario.run(std::min(0.001, seconds(when - scenario.now())));
      look();
    }
  }

  void run(double duration) { run_to(scenario.now() + host_duration(duration)); }

  /// Desired velocity of the arm each ms, and how it changes.
  void look() {
    const auto snapshot = scenario.snapshot();
    if (begin == HostTime{} || snapshot.state != GroupState::Streaming) return;
    const auto& joint = snapshot.joints[2];
    const double velocity = joint.desired.velocity;
    if (seen) worst_acceleration = std::max(worst_acceleration, std::abs(velocity - *seen) / kSync);
    if (joint.desired.position != seen_position) seen = velocity;
    seen_position = joint.desired.position;
    const double lag = 0.06;
    const double t = seconds(scenario.now() - begin) - lag;
    if (t > 0.2) worst_error = std::max(worst_error, std::abs(joint.actual.position - crest(t)));
  }

  static constexpr double kSync = 0.010;  // feedback, and so `desired`, is of the last SYNC

  Scenario scenario{six_axis_cyclic()};
  HostTime begin{};
  std::optional<double> seen;
  double seen_position = 0.0;
  double worst_acceleration = 0.0;
  double worst_error = 0.0;
};

TEST_F(SetpointStreaming, RegularStreamIsFollowedAtItsDelay) {
  stream(3.0, [](int) { return 0.001; });
  EXPECT_EQ(scenario.state(), GroupState::Streaming);
  // Feedback is up to a SYNC period and a millisecond old, at 1.26 rad/s; beyond that, the curve between
  // setpoints.
  EXPECT_LE(worst_error, kAmplitude * 2.0 * kPi * 0.012 + 0.003);
  EXPECT_EQ(scenario.snapshot().setpoints.accepted, 150U);
}

TEST_F(SetpointStreaming, LossAndJitterStayWithinTheLimitsWithoutAStop) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> late;
  int lost = 0;
  for (int k = 0; k < 1500; ++k) {
    const bool is_lost = k > 5 && unit(random) < 0.2;
    lost += is_lost ? 1 : 0;
    late.push_back(is_lost ? -1.0 : unit(random) * kPeriod / 2.0);
  }
  stream(30.0, [&](int k) { return late[static_cast<std::size_t>(k)]; });
  EXPECT_EQ(scenario.state(), GroupState::Streaming);
  EXPECT_GT(lost, 200);
  const auto snapshot = scenario.snapshot();
  EXPECT_EQ(snapshot.setpoints.refused, 0U);
  EXPECT_EQ(snapshot.joints[0].underruns, 0U);
  EXPECT_LE(worst_acceleration, 1.05 * kAcceleration);
  std::cout << "20 % of 50 Hz lost, jitter of half a period: worst error " << worst_error
            << " rad behind the delay, worst change of velocity " << worst_acceleration << " rad/s^2\n";
}

TEST_F(SetpointStreaming, EndsInMotionAtRestWithinTheDistancePredicted) {
  stream(1.25 + kPeriod / 2, [](int) { return 0.001; });  // the sine is fastest here
  const double t = 0.02 * 62;
  run(2.0);
  EXPECT_EQ(scenario.state(), GroupState::Idle);
  const double v = crest_velocity(t);
  // To the last setpoint, 0.1 s of riding through, and 0.75 v^2 / a; the velocity is estimated from
  // setpoints: the parabola's error is T^2 / 3 of the third derivative.
  const double dv = kPeriod * kPeriod / 3.0 * kAmplitude * std::pow(2.0 * kPi, 3);
  const double predicted = crest(t) + 0.1 * v + 0.75 * v * v / kAcceleration;
  EXPECT_NEAR(scenario.positions()[2], predicted, dv * (0.1 + 1.5 * v / kAcceleration) + 1e-3);
}

TEST_F(SetpointStreaming, HandsOverToAGoalAndBackWithoutAJump) {
  stream(1.3, [](int) { return 0.001; });
  const auto accepted = scenario.submit(make_goal({1.5}, {{0.3, 0.3, 0.3, 0.3, 0.3, 0.3}}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  double before = scenario.positions()[2];
  double step = 0.0;
  scenario.run_until(
      [&] {
        const double position = scenario.positions()[2];
        step = std::max(step, std::abs(position - before));
        before = position;
        return scenario.state() == GroupState::Moving;
      },
      3.0);
  EXPECT_LE(step, 1.5 * kSync);  // no more than a SYNC period at 1.5 rad/s
  const auto during = send(setpoint(scenario.now(), 0.0));
  ASSERT_TRUE(during);
  EXPECT_NE(during->text.find("goal is under way"), std::string::npos) << during->text;
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
  EXPECT_NEAR(scenario.positions()[2], 0.3, 1e-3);
  const auto after = send(setpoint(scenario.now(), 0.31));
  EXPECT_FALSE(after) << after->text;
  EXPECT_EQ(scenario.state(), GroupState::Streaming);
  scenario.run(1.0);
  EXPECT_EQ(scenario.state(), GroupState::Idle);
  EXPECT_NEAR(scenario.positions()[2], 0.31, 1e-4);
}

TEST_F(SetpointStreaming, HaltStopsTheStream) {
  stream(1.3, [](int) { return 0.001; });
  const auto id = scenario.driver().halt(scenario.now());
  EXPECT_TRUE(scenario.result_of_request(id, 1.0).success);
  EXPECT_EQ(scenario.state(), GroupState::Idle);
}

TEST_F(SetpointStreaming, FaultOfADriveStopsTheStream) {
  stream(1.3, [](int) { return 0.001; });
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("joint3", "emcy 0x2310", &reason, scenario.now())) << reason;
  EXPECT_TRUE(scenario.run_until_state(GroupState::Fault, 2.0));
  const auto refused = send(setpoint(scenario.now(), 0.0));
  ASSERT_TRUE(refused);
  EXPECT_NE(refused->text.find("0x2310"), std::string::npos) << refused->text;
}

class BadSetpoint : public SetpointStreaming {
 protected:
  void SetUp() override {
    SetpointStreaming::SetUp();
    stream(0.5, [](int) { return 0.001; });
  }

  void expect_refused(const motion::Setpoint& s, const char* part) {
    const auto paths = scenario.snapshot();
    const auto refusal = send(s);
    ASSERT_TRUE(refusal) << "was accepted; expected: " << part;
    EXPECT_NE(refusal->text.find(part), std::string::npos) << refusal->text;
    EXPECT_EQ(scenario.snapshot().setpoints.refused, paths.setpoints.refused + 1);
    EXPECT_EQ(scenario.state(), GroupState::Streaming);
  }

  motion::Setpoint good() { return setpoint(scenario.now(), crest(seconds(scenario.now() - begin))); }
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
  expect_refused(s, "finite");
  s = good();
  s.velocities.assign(6, std::numeric_limits<double>::infinity());
  expect_refused(s, "finite");
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
  run(1.5);
  ASSERT_EQ(scenario.state(), GroupState::Idle);
  const auto refusal = send(setpoint(scenario.now() - std::chrono::milliseconds(300), 0.2));
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->text.find("past"), std::string::npos) << refusal->text;
  EXPECT_EQ(scenario.state(), GroupState::Idle);
}

TEST(SetpointsForOtherDrives, AreRefusedByName) {
  Scenario scenario(six_axis_of_all_kinds());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto refusal = scenario.driver().setpoint(setpoint(scenario.now(), 0.0), scenario.now());
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->text.find("joint3"), std::string::npos) << refusal->text;
}

}  // namespace
}  // namespace interpolated_motion::test
