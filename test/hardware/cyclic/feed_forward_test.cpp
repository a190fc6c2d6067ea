#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "interpolated_motion_driver/hardware/can_bits.h"
#include "interpolated_motion_driver/hardware/drive_kind.h"

// What is sent with each target position: velocity (0x60B1) and torque (0x60B2), and what it makes of the
// following error of an axis with a lag.
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

constexpr double kPi = 3.14159265358979324;
constexpr double kCountsPerRadian = 200000.0 / (2.0 * kPi);
constexpr double kLag = 0.004;  // s, of every axis
constexpr double kCount = 1.0 / kCountsPerRadian;

/// Every drive of the arm with `drive` and, emulated, with a lag and `emulation`.
YAML::Node lagging_arm(const std::string& drive, const std::string& emulation) {
  std::string drives;
  for (int i = 1; i <= 6; ++i) {
    drives += fmt::format("joint{}: {{{}emulation: {{lag_ms: {}, {}}}}}, ", i, drive, 1e3 * kLag, emulation);
  }
  return six_axis_cyclic("{drives: {" + drives + "}}");
}

struct Motion {
  double following_error = 0.0;  ///< rad, greatest
  double velocity = 0.0;         ///< rad/s, greatest of the goal
  double acceleration = 0.0;     ///< rad/s^2
};

/// The planner's goal, and where its axes were against their demand.
Motion move(const YAML::Node& parameters) {
  const trajectory::Goal goal = load_goal(goal_file("six_axis_toppra_20ms_pva.yaml"));
  Motion motion;
  for (const auto& point : goal.points) {
    for (const double v : point.velocities) motion.velocity = std::max(motion.velocity, std::abs(v));
    for (const double a : point.accelerations)
      motion.acceleration = std::max(motion.acceleration, std::abs(a));
  }
  Scenario scenario(parameters);
  EXPECT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  scenario.run(1.0);
  const auto accepted = scenario.submit(goal);
  EXPECT_TRUE(accepted) << accepted.error().text;
  if (!accepted) return motion;
  const auto look = [&] {
    for (const auto& joint : scenario.snapshot().joints)
      motion.following_error = std::max(motion.following_error, std::abs(joint.following_error));
    return scenario.state() == GroupState::Idle;
  };
  EXPECT_TRUE(scenario.run_until(look, 30.0)) << scenario.snapshot().fault;
  return motion;
}

void print(const char* what, const Motion& motion) {
  std::cout << fmt::format("{}: following error at most {:.3f} mrad ({:.1f} counts)\n", what,
                           1e3 * motion.following_error, motion.following_error * kCountsPerRadian);
}

// A position loop of a lag L is behind by L v; with its velocity fed forward, by what its second order
// leaves: L^2 a / 4. Each report is rounded to a count, and acceleration changes.
TEST(FeedForward, TakesTheVelocityOutOfTheFollowingError) {
  const Motion without = move(lagging_arm("velocity_feedforward: false, ", ""));
  const Motion with = move(lagging_arm("", ""));
  print("none", without);
  print("velocity", with);
  EXPECT_NEAR(without.following_error, kLag * without.velocity, 0.05 * kLag * without.velocity);
  EXPECT_LE(with.following_error, 1.2 * kLag * kLag * with.acceleration / 4.0 + 2.0 * kCount);
}

TEST(FeedForward, OfTorqueTakesTheRest) {
  const double torque_per_acceleration = 4.0;  // per mille for 1 rad/s^2
  const Motion with = move(
      lagging_arm(fmt::format("torque_per_acceleration: {}, ", torque_per_acceleration),
                  fmt::format("acceleration_per_torque: {}", kCountsPerRadian / torque_per_acceleration)));
  print("velocity and torque", with);
  EXPECT_LE(with.following_error, 2.0 * kCount);
}

TEST(FeedForward, ADriveThatTakesNoneIsMovedWithout) {
  const Motion motion = move(lagging_arm("torque_per_acceleration: 4, ", "takes_offsets: false"));
  EXPECT_NEAR(motion.following_error, kLag * motion.velocity, 0.05 * kLag * motion.velocity);
}

double bits_per_sync(const std::string& drive) {
  const auto all =
      hardware::parse_configuration(six_axis_cyclic("{drives: {joint1: " + drive + "}}"), six_axis_urdf());
  const hardware::DriveConfiguration& first = all.drives.front();
  return first.kind->bits_per_sync(first, all.bus_of(first));
}

// The budget of a bus has what is sent, and no more.
TEST(FeedForward, CountsForTheBusWhereItIsSent) {
  const double alone = bits_per_sync("{velocity_feedforward: false}");
  const double velocity = bits_per_sync("{}");
  const double torque = bits_per_sync("{torque_per_acceleration: 1.0}");
  EXPECT_EQ(velocity - alone, hardware::longest_frame_bits(8) - hardware::longest_frame_bits(4));
  EXPECT_EQ(torque - velocity, hardware::longest_frame_bits(2));
}

}  // namespace
}  // namespace interpolated_motion::test
