#include <cmath>

#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

TEST_F(FaultInMotion, ErrorOfOneDriveStopsTheGroup) {
  move();
  inject("joint3", "emcy 0x2310");
  expect_stop("Joint joint3 (can0 node 3)");
  EXPECT_TRUE(contains(scenario->snapshot().fault, "0x2310")) << scenario->snapshot().fault;
  expect_recovery();
}

TEST_F(FaultInMotion, BlockedAxisStopsTheGroupWithAFollowingError) {
  move(six_axis("{drives: {joint2: {max_following_error: 0.02}}}"));
  inject("joint2", "stall 1");
  expect_stop("8611", 0.5);
  inject("joint2", "stall 0");
  scenario->run(1.0);
  expect_recovery();
}

TEST_F(FaultInMotion, RestartOfADriveStopsTheGroup) {
  move();
  inject("joint5", "power_cycle 0.1");
  expect_stop("restarted", 0.6, 4);
  scenario->run(1.0);
  expect_recovery();
}

TEST_F(FaultInMotion, LostDriveStopsTheGroup) {
  move();
  inject("joint1", "silence 1");
  expect_stop("Joint joint1", 0.7, 0);
  inject("joint1", "silence 0");
  scenario->run(3.0);
  expect_recovery();
}

// With a full FIFO and nobody to stop it, the drive's own watchdog (0x1016, 0x6007) must.
TEST_F(FaultInMotion, LostDriveBrakesByItselfWhenItNoLongerHearsTheHost) {
  move();
  inject("joint1", "silence 1");
  scenario->run(2.5);  // more than commit_horizon, which its FIFO and its watch last
  inject("joint1", "silence 0");
  scenario->run(0.2);
  const double rest = scenario->positions()[0];
  scenario->run(2.0);
  EXPECT_NEAR(scenario->positions()[0], rest, 1e-4);
}

// A record that never reaches its drive would make it cut the corner. It is missed from the fill the drive
// reports, and the group stops before the drive gets to the hole: no joint leaves the path before the stop.
TEST_F(FaultInMotion, LostRecordIsNoticedBeforeTheDriveGetsThere) {
  move(six_axis(), 0.5);
  inject("can0", "drop_id 0x204 1");
  expect_stop("Joint joint4 (can0 node 4)", 4.0);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "record was lost")) << scenario->snapshot().fault;
  EXPECT_LE(scenario->driver().report().joints[3].worst_deviation, 1.0);
  expect_recovery();
}

TEST_F(FaultInMotion, BusOffStopsEveryDriveByItsOwnWatchdog) {
  move();
  inject("can0", "bus_off 2.0");
  scenario->run(1.5);
  const auto result = scenario->result_of(goal);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  scenario->run(2.0);
  expect_recovery();
}

TEST(FaultAtStart, LostRecordInThePrefillIsRepaired) {
  Scenario scenario;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("can0", "drop_id 0x202 2", &reason, scenario.now())) << reason;
  const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_20ms_pva.yaml")));
  ASSERT_TRUE(accepted);
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
  EXPECT_EQ(scenario.snapshot().joints[1].refused_writes, 2u);
  EXPECT_LE(scenario.driver().report().joints[1].worst_deviation, 1.0);
}

// Without its controlword one drive does not start: the others must not go on without it.
TEST(FaultAtStart, LostStartCommandStopsTheGroup) {
  Scenario scenario;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_20ms_pva.yaml")));
  ASSERT_TRUE(accepted);
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("can0", "drop_id 0x306 1", &reason, scenario.now())) << reason;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_TRUE(contains(result.text, "does not start")) << result.text;
  EXPECT_NEAR(scenario.positions()[5], 0.0, 1e-6);
  EXPECT_LT(std::abs(scenario.positions()[0]), 0.5);
}

TEST(FaultAtRest, DriveFaultWhileIdleRefusesGoals) {
  Scenario scenario;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("joint6", "emcy 0x4210", &reason, scenario.now()));
  scenario.run(0.1);
  EXPECT_EQ(scenario.state(), GroupState::Fault);
  const auto refused = scenario.submit(make_goal({1.0}, {{0.1, 0.1, 0.1, 0.1, 0.1, 0.1}}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, GoalError::InvalidGoal);
  EXPECT_TRUE(contains(refused.error().text, "0x4210")) << refused.error().text;
  EXPECT_TRUE(contains(refused.error().text, "~reset_faults")) << refused.error().text;
}

TEST(FaultAtRest, LostSdoRepliesDuringBringUpAreRepeated) {
  Scenario scenario;
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("can0", "drop_id 0x583 2", &reason, scenario.now())) << reason;
  EXPECT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
}

}  // namespace
}  // namespace interpolated_motion::test
