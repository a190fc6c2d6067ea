#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "hardware/silverlode/line_traffic.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr int kImw = 25;

void expect_followed(Scenario& scenario, double bound, double final_bound) {
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_GT(joint.samples, 0U) << joint.joint;
    EXPECT_LE(joint.worst_deviation, bound) << joint.joint;
    EXPECT_LE(joint.final_deviation, final_bound) << joint.joint;
    EXPECT_EQ(joint.underruns, 0U) << joint.joint;
  }
}

class SilverlodeGoals : public testing::TestWithParam<const char*> {};

// "Full" is known from the clock; NAK 6 is not how the driver finds out.
TEST_P(SilverlodeGoals, AreFollowedAtEveryServoTickWithHardlyANak) {
  Scenario scenario(six_axis_silverlode());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  LineTraffic traffic(scenario);
  const auto accepted = scenario.submit(load_goal(goal_file(GetParam())));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  expect_followed(scenario, 2.0, 1.0);
  EXPECT_GT(traffic.commands(kImw), 6U * 20U) << "the counter does not see the segments";
  EXPECT_LE(static_cast<double>(traffic.naks()), 0.005 * static_cast<double>(traffic.commands()));
}

/// Six drives on one line at 57600 baud instead of two.
YAML::Node one_line() {
  YAML::Node arm = six_axis_silverlode();
  arm["buses"].remove("line1");
  for (int i = 4; i <= 6; ++i) arm["drives"]["joint" + std::to_string(i)]["bus"] = "line0";
  return arm;
}

// Which goals fit one line is said before anything moves: what is accepted is followed as with two lines,
// what is refused names the line and its figure.
TEST_P(SilverlodeGoals, FitOneLineOrAreRefusedBeforeAnythingMoves) {
  Scenario scenario(one_line());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  LineTraffic traffic(scenario);
  const auto accepted = scenario.submit(load_goal(goal_file(GetParam())));
  if (!accepted) {
    std::printf("%s: %s\n", GetParam(), accepted.error().text.c_str());
    EXPECT_NE(accepted.error().text.find("Bus line0 cannot carry the goal"), std::string::npos)
        << accepted.error().text;
    EXPECT_NE(accepted.error().text.find("records in the second before"), std::string::npos)
        << accepted.error().text;
    const auto before = scenario.positions();
    scenario.run(1.0);
    EXPECT_EQ(scenario.positions(), before);
    EXPECT_EQ(traffic.commands(kImw), 0U);
    return;
  }
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  expect_followed(scenario, 2.0, 1.0);
  EXPECT_LE(static_cast<double>(traffic.naks()), 0.005 * static_cast<double>(traffic.commands()));
  std::printf("%s: fits one line, %llu segments, peak load %.0f %%\n", GetParam(),
              static_cast<unsigned long long>(traffic.commands(kImw)),
              100.0 * scenario.driver().report().peak_bus_load.front().second);
}

INSTANTIATE_TEST_SUITE_P(Planned, SilverlodeGoals,
                         testing::Values("six_axis_toppra_100ms_pv.yaml", "six_axis_toppra_100ms_pva.yaml",
                                         "six_axis_toppra_20ms_pva.yaml"));

// Drives or adapters that answer later than the plan has it leave no gap between segments. As long as these
// come in time that is no fault, and the drives are looked at all the same.
TEST(SilverlodeGoalOnALateLine, IsFollowedAndTheDelayIsReported) {
  std::string drives;
  for (int i = 1; i <= 6; ++i) drives += fmt::format("joint{}: {{emulation: {{turnaround: 0.010}}}}, ", i);
  Scenario scenario(six_axis_silverlode(
      "{buses: {line0: {reply_timeout: 0.05}, line1: {reply_timeout: 0.05}}, drives: {" + drives + "}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle, 30.0)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  expect_followed(scenario, 2.0, 1.0);
  for (const auto& bus : scenario.snapshot().buses) {
    ASSERT_TRUE(bus.reply_delay) << bus.name;
    EXPECT_NEAR(bus.reply_delay->mean, 0.010, 0.0005) << bus.name;
    EXPECT_DOUBLE_EQ(bus.reply_delay->planned, 0.002) << bus.name;
  }
}

// A stop ends anywhere between two counts; the next goal keeps its bound all the same.
TEST(SilverlodeGoalAfterAStop, KeepsTheBound) {
  Scenario scenario(six_axis_silverlode());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  for (int i = 0; i < 5; ++i) {
    const auto first = scenario.submit(make_goal({1.0}, {{0.5, -0.5, 0.4, 0.3, -0.2, 0.1}}));
    ASSERT_TRUE(first) << first.error().text;
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
    scenario.run(0.9 + 0.037 * i);
    scenario.driver().cancel(first.value().id, scenario.now());
    EXPECT_EQ(scenario.result_of(first.value().id).outcome, GoalOutcome::Preempted);
    const auto second = scenario.submit(make_goal({1.0}, {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}}));
    ASSERT_TRUE(second) << second.error().text;
    const auto result = scenario.result_of(second.value().id);
    EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
    expect_followed(scenario, 2.0, 1.0);
  }
}

// The budget must not be so wide that it never refuses: at 9600 baud the same goals need more than the line.
TEST(SilverlodeBudget, SlowLineRefusesWithTheFigure) {
  Scenario scenario(six_axis_silverlode("{buses: {line0: {baud: 9600}, line1: {baud: 9600}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle, 30.0)) << scenario.snapshot().fault;
  LineTraffic traffic(scenario);
  const auto answer = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
  ASSERT_FALSE(answer);
  EXPECT_NE(answer.error().text.find("cannot carry the goal: at "), std::string::npos) << answer.error().text;
  scenario.run(1.0);
  EXPECT_EQ(traffic.commands(kImw), 0U);
  for (const double position : scenario.positions()) EXPECT_EQ(position, 0.0);
}

}  // namespace
}  // namespace interpolated_motion::test
