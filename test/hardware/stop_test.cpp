#include <cmath>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

class StopInMotion : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
    const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
    ASSERT_TRUE(accepted);
    goal = accepted.value().id;
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
    scenario.run(1.5);
  }

  void expect_rest() {
    const auto before = scenario.positions();
    scenario.run(2.0);
    const auto after = scenario.positions();
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_NEAR(after[i], before[i], 1e-3) << "joint" << i + 1;
  }

  void expect_that_a_new_goal_works() {
    std::vector<double> target = scenario.positions();
    for (double& position : target) position -= 0.1;
    const auto accepted = scenario.submit(make_goal({0.8}, {target}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
    for (const auto& joint : scenario.driver().report().joints)
      EXPECT_LE(joint.worst_deviation, 1.0) << joint.joint;
  }

  Scenario scenario;
  motion::GoalId goal = 0;
};

TEST_F(StopInMotion, CancelBringsTheGroupToRest) {
  scenario.driver().cancel(goal, scenario.now());
  EXPECT_EQ(scenario.result_of(goal, 1.0).outcome, GoalOutcome::Preempted);
  EXPECT_EQ(scenario.state(), GroupState::Idle);
  expect_rest();
  expect_that_a_new_goal_works();
}

TEST_F(StopInMotion, HaltAbortsTheGoal) {
  const auto id = scenario.driver().halt(scenario.now());
  EXPECT_TRUE(scenario.result_of_request(id, 1.0).success);
  const auto result = scenario.result_of(goal, 1.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_NE(result.text.find("~halt"), std::string::npos) << result.text;
  expect_rest();
  expect_that_a_new_goal_works();
}

TEST_F(StopInMotion, DisableStopsFirst) {
  const auto id = scenario.driver().enable(false, scenario.now());
  EXPECT_TRUE(scenario.result_of_request(id, 2.0).success);
  EXPECT_EQ(scenario.result_of(goal, 1.0).outcome, GoalOutcome::Aborted);
  EXPECT_EQ(scenario.state(), GroupState::Disabled);
  EXPECT_EQ(scenario.snapshot().joints[0].state, "switch on disabled");
}

TEST_F(StopInMotion, EmptyGoalIsAStopThatSucceeds) {
  trajectory::Goal empty;
  empty.joint_names = load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")).joint_names;
  const auto accepted = scenario.submit(empty);
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_EQ(scenario.result_of(accepted.value().id, 1.0).outcome, GoalOutcome::Succeeded);
  EXPECT_EQ(scenario.result_of(goal, 1.0).outcome, GoalOutcome::Preempted);
  expect_rest();
}

TEST_F(StopInMotion, CancellingTheGoalThatWaitsForAStopLeavesTheStopAlone) {
  trajectory::Goal empty;
  empty.joint_names = load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")).joint_names;
  const auto stop = scenario.submit(empty);
  ASSERT_TRUE(stop) << stop.error().text;
  const auto waiting = scenario.submit(make_goal({2.0}, {{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}}));
  ASSERT_TRUE(waiting) << waiting.error().text;
  scenario.driver().cancel(waiting.value().id, scenario.now());
  EXPECT_EQ(scenario.result_of(waiting.value().id, 1.0).outcome, GoalOutcome::Preempted);
  EXPECT_EQ(scenario.result_of(stop.value().id, 1.0).outcome, GoalOutcome::Succeeded);
  expect_rest();
}

TEST_F(StopInMotion, NewGoalReplacesTheRunningOne) {
  const auto accepted = scenario.submit(make_goal({2.0}, {{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_EQ(scenario.result_of(goal, 1.0).outcome, GoalOutcome::Preempted);
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
  EXPECT_NEAR(scenario.positions()[5], 0.6, 1e-4);
}

TEST_F(StopInMotion, ReplacementThatTheArmCannotGetIntoIsRefusedAndTheGoalGoesOn) {
  const auto answer = scenario.submit(load_goal(goal_file("six_axis_toppra_20ms_pva.yaml")));
  ASSERT_FALSE(answer);
  EXPECT_NE(answer.error().text.find("joint"), std::string::npos) << answer.error().text;
  EXPECT_EQ(scenario.result_of(goal).outcome, GoalOutcome::Succeeded);
}

TEST_F(StopInMotion, BadReplacementLeavesTheRunningGoalAlone) {
  auto bad = make_goal({2.0}, {{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}});
  bad.points[0].positions[2] = std::nan("");
  EXPECT_FALSE(scenario.submit(bad));
  EXPECT_EQ(scenario.result_of(goal).outcome, GoalOutcome::Succeeded);
}

// Halt decelerates each axis by its own limit: the distance is v^2 / 2a, beyond what it travels until the
// command arrives.
TEST_F(StopInMotion, StoppingDistanceIsThatOfTheDeceleration) {
  const auto before = scenario.snapshot();
  scenario.driver().cancel(goal, scenario.now());
  scenario.result_of(goal, 1.0);
  const auto rest = scenario.positions();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const auto& start = before.joints[i].desired;
    const double least = start.velocity * start.velocity / (2.0 * 20.0);
    const double travelled = std::abs(rest[i] - start.position);
    EXPECT_NEAR(travelled, least, std::abs(start.velocity) * 0.03 + 0.01) << "joint" << i + 1;
  }
}

}  // namespace
}  // namespace interpolated_motion::test
