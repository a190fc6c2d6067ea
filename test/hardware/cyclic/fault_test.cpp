#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

class CyclicFault : public FaultInMotion {
 protected:
  void expect_ridden_through(double bound) {
    const auto result = scenario->result_of(goal);
    EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
    for (const auto& joint : scenario->driver().report().joints) {
      EXPECT_LE(joint.worst_deviation, bound) << joint.joint;
      EXPECT_LE(joint.final_deviation, 1.0) << joint.joint;
    }
  }

  /// Largest error of a cubic extrapolation over `late` periods, counts: the polynomial through four points
  /// in a period of T leaves out the fourth derivative, and w(t) = t (t+T) (t+2T) (t+3T) / 24 of it. The
  /// planner's quintics reach about 2e4 rad/s^4 in the fourth derivative between points 100 ms apart.
  static double extrapolation_bound(int late) {
    constexpr double kPeriod = 0.010;
    constexpr double kFourthDerivative = 2e4;
    const double t = late;
    const double w = t * (t + 1) * (t + 2) * (t + 3) * std::pow(kPeriod, 4) / 24.0;
    return kFourthDerivative * w * 100.0 * 2000.0 / (2.0 * 3.14159265358979324) + 5.0;
  }
};

TEST_F(CyclicFault, LostTargetPositionsAreRiddenThrough) {
  move(six_axis_cyclic());
  inject("can0", "drop_id 0x203 2");
  expect_ridden_through(extrapolation_bound(2));
}

// No drive answers the two that are lost, so the host does not count on what was for them. It knows of the
// first when it sends the target position of the third, and that the third is answered when it sends that of
// the fifth, for an instant five periods behind the last one that is sure: from there it leads them back,
// while a step back would be far beyond their limits.
TEST_F(CyclicFault, LostSyncsAreRiddenThroughByAllDrives) {
  move(six_axis_cyclic());
  inject("can0", "drop_id 0x80 2");
  expect_ridden_through(extrapolation_bound(5));
}

TEST_F(CyclicFault, MoreLostTargetPositionsThanTheLimitStopTheGroup) {
  move(six_axis_cyclic());
  inject("can0", "drop_id 0x203 6");
  expect_stop("0x8700", 0.15);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "Joint joint3 (can0 node 3)"))
      << scenario->snapshot().fault;
  expect_recovery();
}

TEST_F(CyclicFault, ErrorOfOneDriveStopsTheGroup) {
  move(six_axis_cyclic());
  inject("joint3", "emcy 0x2310");
  expect_stop("Joint joint3 (can0 node 3)", 0.1);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "0x2310")) << scenario->snapshot().fault;
  expect_recovery();
}

TEST_F(CyclicFault, BlockedAxisStopsTheGroupWithAFollowingError) {
  move(six_axis_cyclic("{drives: {joint2: {max_following_error: 0.02}}}"));
  inject("joint2", "stall 1");
  expect_stop("0x8611", 0.5);
  inject("joint2", "stall 0");
  scenario->run(1.0);
  expect_recovery();
}

TEST_F(CyclicFault, RestartOfADriveStopsTheGroup) {
  move(six_axis_cyclic());
  inject("joint5", "power_cycle 0.1");
  expect_stop("restarted", 0.7, 4);
  scenario->run(1.0);
  expect_recovery();
}

TEST_F(CyclicFault, LostDriveStopsTheGroup) {
  move(six_axis_cyclic());
  inject("joint1", "silence 1");
  expect_stop("Joint joint1", 0.7, 0);
  inject("joint1", "silence 0");
  scenario->run(3.0);
  expect_recovery();
}

// The host is off the bus: no drive hears SYNC or target positions, and each stops by itself within the
// distance of its ride-through and its ramp, long before a heartbeat is missed.
TEST_F(CyclicFault, HostOffTheBusStopsEveryDriveByItself) {
  move(six_axis_cyclic());
  const auto before = scenario->snapshot();
  inject("can0", "bus_off 1.0");
  scenario->run(1.5);
  EXPECT_EQ(scenario->result_of(goal).outcome, GoalOutcome::Aborted);
  const auto rest = scenario->positions();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    constexpr double kRideThrough = 0.06;  // three periods, one under way, one already sent
    const double v = std::abs(before.joints[i].actual.velocity) + kAcceleration * kRideThrough;
    const double reach = v * kRideThrough + v * v / (2.0 * kAcceleration);
    EXPECT_LE(std::abs(rest[i] - before.joints[i].actual.position), reach) << "joint" << i + 1;
  }
  scenario->run(1.0);
  expect_recovery();
}

class CyclicStop : public FaultInMotion {};

// The stop is a smooth one: v^2 / 2a at 0.9 of the limit, with ramps of 30 to 120 ms, and what the drive
// travels until the first target position of the stop is reached: two periods for those on their way, one to
// the next SYNC.
TEST_F(CyclicStop, CancelStopsWithinTheDistanceOfTheStopPath) {
  move(six_axis_cyclic());
  const auto before = scenario->snapshot();
  scenario->driver().cancel(goal, scenario->now());
  EXPECT_EQ(scenario->result_of(goal, 1.5).outcome, GoalOutcome::Preempted);
  EXPECT_EQ(scenario->state(), GroupState::Idle);
  const auto rest = scenario->positions();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const auto& start = before.joints[i].desired;
    const double speed = std::abs(start.velocity);
    const double expected = 0.5 * speed * (speed / (0.9 * kAcceleration) + 0.06);
    const double travelled = std::abs(rest[i] - start.position);
    EXPECT_NEAR(travelled, expected, speed * 0.045 + 0.02) << "joint" << i + 1;
  }
  std::vector<double> target = rest;
  for (double& position : target) position -= 0.1;
  const auto accepted = scenario->submit(make_goal({0.8}, {target}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_EQ(scenario->result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
  for (const auto& joint : scenario->driver().report().joints)
    EXPECT_LE(joint.worst_deviation, 5.0) << joint.joint;
}

// No joint exceeds its acceleration while it stops: second differences of the drives' demand over 10 ms.
TEST_F(CyclicStop, KeepsTheLimitOfAcceleration) {
  move(six_axis_cyclic());
  std::vector<std::vector<double>> positions(6);
  const auto record = [&] {
    for (std::size_t i = 0; i < 6; ++i) positions[i].push_back(scenario->positions()[i]);
  };
  scenario->driver().cancel(goal, scenario->now());
  for (int i = 0; i < 60; ++i) {
    scenario->run(0.010);
    record();
  }
  constexpr double kResolution = 4.0 / (31830.0 * 1e-4);  // rad/s^2: four roundings of half a count, twice
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 2; k < positions[i].size(); ++k) {
      const double second = positions[i][k] - 2.0 * positions[i][k - 1] + positions[i][k - 2];
      EXPECT_LE(std::abs(second) / 1e-4, 1.05 * kAcceleration + kResolution) << "joint" << i + 1 << ", " << k;
    }
  }
}

}  // namespace
}  // namespace interpolated_motion::test
