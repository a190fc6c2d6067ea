#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

// Requests that come at the wrong moment: while the drives are being enabled, in motion, in fault. Each is
// answered, at once where nothing is to be waited for, and what it says is so.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

struct Arm {
  std::string name;
  std::function<YAML::Node(const std::string& changes)> parameters;
  std::string fault;       ///< of one drive
  std::string off;         ///< what the power stage's being off is called
  double enabling = 0.02;  ///< s after ~enable in which the drives are being enabled
};

void PrintTo(const Arm& arm, std::ostream* out) { *out << arm.name; }

const std::vector<double> kTarget{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};

class RequestOfArm : public ::testing::TestWithParam<Arm> {
 protected:
  static YAML::Node switched_off() { return GetParam().parameters("enable_on_start: false"); }

  static bool is_off(Scenario& scenario, std::size_t joint) {
    return scenario.snapshot().joints[joint].state == GetParam().off;
  }
  static void expect_all_off(Scenario& scenario) {
    for (std::size_t i = 0; i < kTarget.size(); ++i) {
      EXPECT_TRUE(is_off(scenario, i)) << "joint" << i + 1 << ": " << scenario.snapshot().joints[i].state;
    }
  }
  static motion::GoalId start_moving(Scenario& scenario) {
    EXPECT_TRUE(scenario.run_until_state(GroupState::Idle));
    const auto accepted = scenario.submit(make_goal({3.0}, {kTarget}));
    EXPECT_TRUE(accepted) << accepted.error().text;
    EXPECT_TRUE(scenario.run_until_state(GroupState::Moving));
    scenario.run(1.0);
    return accepted.value().id;
  }
};

TEST_P(RequestOfArm, DisableWhileEnablingEndsSwitchedOff) {
  Scenario scenario(switched_off());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Disabled));
  const auto on = scenario.driver().enable(true, scenario.now());
  scenario.run(GetParam().enabling);
  ASSERT_EQ(scenario.state(), GroupState::Enabling);
  const auto off = scenario.driver().enable(false, scenario.now());
  EXPECT_TRUE(scenario.result_of_request(off, 5.0).success);
  EXPECT_FALSE(scenario.result_of_request(on, 1.0).success);
  EXPECT_EQ(scenario.state(), GroupState::Disabled);
  expect_all_off(scenario);

  const auto again = scenario.driver().enable(true, scenario.now());
  EXPECT_TRUE(scenario.result_of_request(again, 5.0).success);
  const auto accepted = scenario.submit(make_goal({1.0}, {kTarget}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
}

TEST_P(RequestOfArm, DisableWhileTheDrivesAreBeingFoundEndsSwitchedOff) {
  Scenario scenario(GetParam().parameters(""));
  scenario.run(0.05);
  ASSERT_EQ(scenario.state(), GroupState::Starting);
  const auto off = scenario.driver().enable(false, scenario.now());
  EXPECT_TRUE(scenario.result_of_request(off, 10.0).success);
  scenario.run(2.0);
  EXPECT_EQ(scenario.state(), GroupState::Disabled);
  expect_all_off(scenario);
}

TEST_P(RequestOfArm, EnableWhileTheDrivesAreBeingFoundIsAnsweredWhenTheyAreOn) {
  Scenario scenario(switched_off());
  scenario.run(0.05);
  ASSERT_EQ(scenario.state(), GroupState::Starting);
  const auto on = scenario.driver().enable(true, scenario.now());
  const auto result = scenario.result_of_request(on, 10.0);
  EXPECT_TRUE(result.success) << result.message;
  EXPECT_EQ(scenario.state(), GroupState::Idle);
}

TEST_P(RequestOfArm, ResetInMotionIsAnsweredAtOnceAndChangesNothing) {
  Scenario scenario(GetParam().parameters(""));
  const auto goal = start_moving(scenario);
  const auto result = scenario.result_of_request(scenario.driver().reset_faults(scenario.now()), 0.05);
  EXPECT_FALSE(result.success);
  EXPECT_NE(result.message.find("moving"), std::string::npos) << result.message;
  EXPECT_EQ(scenario.result_of(goal).outcome, GoalOutcome::Succeeded);
}

TEST_P(RequestOfArm, EnableInMotionIsAnsweredAtOnceAndChangesNothing) {
  Scenario scenario(GetParam().parameters(""));
  const auto goal = start_moving(scenario);
  EXPECT_TRUE(scenario.result_of_request(scenario.driver().enable(true, scenario.now()), 0.05).success);
  EXPECT_EQ(scenario.result_of(goal).outcome, GoalOutcome::Succeeded);
}

// A halt is answered when the group rests, though a goal that waited for that begins at once.
TEST_P(RequestOfArm, HaltWhileStoppingIsAnsweredBeforeTheNextGoal) {
  Scenario scenario(GetParam().parameters(""));
  start_moving(scenario);
  const auto clear = scenario.driver().clear_buffers(scenario.now());
  const auto halt = scenario.driver().halt(scenario.now());
  const auto accepted = scenario.submit(make_goal({10.0}, {kTarget}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_TRUE(scenario.result_of_request(clear, 1.5).success);
  EXPECT_TRUE(scenario.result_of_request(halt, 0.1).success);
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
}

TEST_P(RequestOfArm, DisableAndEnableAtOneInstantAreBothAnswered) {
  Scenario scenario(switched_off());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Disabled));
  const auto off = scenario.driver().enable(false, scenario.now());
  const auto on = scenario.driver().enable(true, scenario.now());
  EXPECT_TRUE(scenario.result_of_request(off, 0.1).success);
  EXPECT_TRUE(scenario.result_of_request(on, 5.0).success);
  EXPECT_EQ(scenario.state(), GroupState::Idle);
}

TEST_P(RequestOfArm, DisableInFaultSwitchesTheOtherDrivesOff) {
  Scenario scenario(GetParam().parameters(""));
  start_moving(scenario);
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("joint2", GetParam().fault, &reason, scenario.now())) << reason;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Fault));
  ASSERT_FALSE(is_off(scenario, 0)) << "the others hold their positions until they are told otherwise";
  const auto id = scenario.driver().enable(false, scenario.now());
  for (int i = 0; i < 100; ++i, scenario.run(0.005))
    ASSERT_EQ(scenario.state(), GroupState::Fault) << "only a reset ends a fault";
  const auto result = scenario.result_of_request(id, 5.0);
  EXPECT_FALSE(result.success) << "one drive is in fault";
  EXPECT_NE(result.message.find("joint2"), std::string::npos) << result.message;
  EXPECT_EQ(scenario.state(), GroupState::Fault);
  for (const std::size_t joint : {0U, 2U, 3U, 4U, 5U})
    EXPECT_TRUE(is_off(scenario, joint)) << "joint" << joint + 1;
}

// A reset leaves the drives on that were not in fault.
TEST_P(RequestOfArm, DisableAfterAResetSwitchesAllDrivesOff) {
  Scenario scenario(GetParam().parameters(""));
  start_moving(scenario);
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("joint2", GetParam().fault, &reason, scenario.now())) << reason;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Fault));
  scenario.run(0.5);
  ASSERT_TRUE(scenario.result_of_request(scenario.driver().reset_faults(scenario.now()), 10.0).success);
  ASSERT_TRUE(scenario.result_of_request(scenario.driver().enable(false, scenario.now()), 5.0).success);
  EXPECT_EQ(scenario.state(), GroupState::Disabled);
  expect_all_off(scenario);
}

TEST_P(RequestOfArm, ShuttingDownTellsTheGoalWhy) {
  Scenario scenario(GetParam().parameters(""));
  const auto goal = start_moving(scenario);
  EXPECT_TRUE(scenario.result_of_request(scenario.driver().shut_down(scenario.now()), 5.0).success);
  const auto result = scenario.result_of(goal, 1.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_NE(result.text.find("shutting down"), std::string::npos) << result.text;
  EXPECT_EQ(result.text.find("~halt"), std::string::npos) << result.text;
  expect_all_off(scenario);
}

const Arm kArms[] = {
    {"Epos", six_axis, "emcy 0x2310", "switch on disabled"},
    {"Silverlode", six_axis_silverlode, "fault over_voltage", "Driver disabled"},
    {"Cyclic", six_axis_cyclic, "emcy 0x2310", "switch on disabled"},
};

INSTANTIATE_TEST_SUITE_P(Kinds, RequestOfArm, ::testing::ValuesIn(kArms),
                         [](const auto& arm) { return arm.param.name; });

}  // namespace
}  // namespace interpolated_motion::test
