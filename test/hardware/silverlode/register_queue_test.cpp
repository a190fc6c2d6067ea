#include <cstdio>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"
#include "hardware/scenario.h"
#include "hardware/silverlode/line_traffic.h"

// The register-based queue: four user registers a segment, and register 17 for the handshake.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr int kWri = 11;
constexpr int kImw = 25;
constexpr int kImq = 254;

/// The arm of two lines, all drives fed through registers.
YAML::Node register_arm(int blocks, int drives_on_a_line = 3, int baud = 57'600, int lost_replies = 1) {
  YAML::Node arm = six_axis_silverlode();
  for (int i = 1; i <= 6; ++i) {
    const std::string line = fmt::format("line{}", (i - 1) / drives_on_a_line);
    arm["buses"][line]["type"] = "silverlode";
    arm["buses"][line]["baud"] = baud;
    YAML::Node drive = arm["drives"][fmt::format("joint{}", i)];
    drive["bus"] = line;
    drive["queue"] = "register";
    drive["register_blocks"] = blocks;
    drive["lost_replies"] = lost_replies;
    drive["emulation"]["clock_error_ppm"] = 40 * i - 140;
  }
  return arm;
}

/// Up and down in four seconds each, as slow as three drives on a line can be fed through registers.
trajectory::Goal slow_goal() {
  std::vector<double> times;
  std::vector<std::vector<double>> positions;
  for (int i = 1; i <= 4; ++i) {
    const double way = i % 2 == 0 ? 0.0 : 0.4;
    times.push_back(4.0 * i);
    positions.push_back({way, -way, 0.5 * way, way, -0.7 * way, 0.3 * way});
  }
  return make_goal(times, positions);
}

void expect_followed(Scenario& scenario) {
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_GT(joint.samples, 0U) << joint.joint;
    EXPECT_LE(joint.worst_deviation, 2.0) << joint.joint;
    EXPECT_LE(joint.final_deviation, 1.0) << joint.joint;
    EXPECT_EQ(joint.underruns, 0U) << joint.joint;
  }
}

class RegisterQueue : public testing::TestWithParam<int> {};

TEST_P(RegisterQueue, SlowGoalIsFollowedByThreeDrivesOnALine) {
  Scenario scenario(register_arm(GetParam()));
  LineTraffic traffic(scenario);
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  EXPECT_EQ(scenario.snapshot().joints[0].capacity, static_cast<std::uint32_t>(GetParam()));
  const auto accepted = scenario.submit(slow_goal());
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  expect_followed(scenario);
  EXPECT_EQ(traffic.commands(kImw) + traffic.commands(kImq), 0U) << "the FIFO is not used";
  EXPECT_EQ(traffic.naks(), 0U);
}

/// One line a drive, at which the planner's goals fit or are refused with the figure before anything moves.
TEST_P(RegisterQueue, PlannersGoalsOnALineADriveAreFollowedOrRefused) {
  for (const char* file :
       {"six_axis_toppra_100ms_pv.yaml", "six_axis_toppra_100ms_pva.yaml", "six_axis_toppra_20ms_pva.yaml"}) {
    for (const int baud : {57'600, 230'400}) {
      Scenario scenario(register_arm(GetParam(), 1, baud, 0));
      ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
      LineTraffic traffic(scenario);
      const auto accepted = scenario.submit(load_goal(goal_file(file)));
      if (!accepted) {
        std::printf("%s, %d blocks, %d baud: %s\n", file, GetParam(), baud, accepted.error().text.c_str());
        EXPECT_TRUE(contains(accepted.error().text, "cannot carry the goal") ||
                    contains(accepted.error().text, "no segment of "))
            << accepted.error().text;
        scenario.run(0.5);
        EXPECT_EQ(traffic.commands(kWri), 0U);
        continue;
      }
      const auto result = scenario.result_of(accepted.value().id);
      EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
      expect_followed(scenario);
      std::printf("%s, %d blocks, %d baud: fits, %llu writes\n", file, GetParam(), baud,
                  static_cast<unsigned long long>(traffic.commands(kWri)));
    }
  }
}

TEST_P(RegisterQueue, TenGoalsInARowLeaveNothingBehind) {
  Scenario scenario(register_arm(GetParam()));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  for (int i = 1; i <= 10; ++i) {
    const double way = 0.05 * i;
    const auto accepted = scenario.submit(make_goal({1.5}, {{way, way, way, way, way, way}}));
    ASSERT_TRUE(accepted) << i << ": " << accepted.error().text;
    const auto result = scenario.result_of(accepted.value().id);
    ASSERT_EQ(result.outcome, GoalOutcome::Succeeded) << i << ": " << result.text;
    expect_followed(scenario);
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, RegisterQueue, testing::Values(1, 2, 5));

// Replies are lost at any time, to writes of data and to the hand-over alike: everything is written again,
// and nothing of it is executed twice or left out.
class RegisterQueueLostReplies : public testing::TestWithParam<unsigned> {};

TEST_P(RegisterQueueLostReplies, CostNothing) {
  std::mt19937 random(GetParam());
  Scenario scenario(register_arm(1 + static_cast<int>(GetParam() % 3)));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(slow_goal());
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  int losses = 0;
  while (scenario.state() == GroupState::Moving) {
    scenario.run(0.15 + 1e-3 * static_cast<double>(random() % 200));
    std::string reason;
    ASSERT_TRUE(scenario.driver().inject(random() % 2 == 0 ? "line0" : "line1",
                                         fmt::format("lose_replies {}", 1 + random() % 5), &reason,
                                         scenario.now()))
        << reason;
    ++losses;
  }
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  EXPECT_GT(losses, 40);
  expect_followed(scenario);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RegisterQueueLostReplies, testing::Range(0U, 24U));

class RegisterQueueInMotion : public FaultInMotion {
 protected:
  void move(int blocks) {
    scenario = std::make_unique<Scenario>(register_arm(blocks));
    ASSERT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
    const auto accepted = scenario->submit(slow_goal());
    ASSERT_TRUE(accepted) << accepted.error().text;
    goal = accepted.value().id;
    ASSERT_TRUE(scenario->run_until_state(GroupState::Moving));
    scenario->run(2.0);
  }
};

TEST_F(RegisterQueueInMotion, CutCableStopsEveryDriveOfTheLineByItself) {
  move(2);
  inject("line0", "disconnect 1");
  EXPECT_EQ(scenario->result_of(goal).outcome, GoalOutcome::Aborted);
  scenario->run(3.0);
  const auto rest = scenario->positions();
  inject("line0", "disconnect 0");
  scenario->run(1.0);
  expect_recovery();
}

TEST_F(RegisterQueueInMotion, StopLeavesNothingToBePlayed) {
  move(2);
  scenario->driver().cancel(goal, scenario->now());
  EXPECT_EQ(scenario->result_of(goal).outcome, GoalOutcome::Preempted);
  ASSERT_TRUE(scenario->run_until_state(GroupState::Idle));
  const auto rest = scenario->positions();
  scenario->run(2.0);
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(scenario->positions()[i], rest[i], 1e-4);
  std::vector<double> target = rest;
  for (double& position : target) position += 0.2;
  const auto accepted = scenario->submit(make_goal({2.0}, {target}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_EQ(scenario->result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
  expect_followed(*scenario);
}

TEST(RegisterQueueBudget, WhatTheLineCannotCarryIsRefusedWithTheFigure) {
  YAML::Node arm = register_arm(2);
  for (const char* line : {"line0", "line1"}) arm["buses"][line]["max_load"] = 0.2;
  Scenario scenario(arm);
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  LineTraffic traffic(scenario);
  const auto answer = scenario.submit(slow_goal());
  ASSERT_FALSE(answer);
  EXPECT_TRUE(contains(answer.error().text, "cannot carry the goal: at ")) << answer.error().text;
  scenario.run(1.0);
  EXPECT_EQ(traffic.commands(kWri), 0U);
}

TEST(RegisterQueueConfiguration, RegistersOfTheDriveItselfAreRefused) {
  const auto message_of = [](int first, int blocks) -> std::string {
    YAML::Node arm = register_arm(blocks);
    arm["drives"]["joint2"]["first_register"] = first;
    try {
      Scenario scenario(arm);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of(25, 2), "");
  EXPECT_EQ(message_of(11, 1), "");
  EXPECT_EQ(message_of(13, 1), "") << "13..16";
  for (const auto& [first, blocks] :
       {std::pair{10, 1}, {14, 1}, {16, 1}, {24, 1}, {13, 2}, {197, 1}, {190, 3}}) {
    const std::string message = message_of(first, blocks);
    EXPECT_TRUE(contains(message, "drives/joint2/first_register")) << first << ": " << message;
    EXPECT_TRUE(contains(message, "11..16 and 25..199")) << first << ": " << message;
  }
}

}  // namespace
}  // namespace interpolated_motion::test
