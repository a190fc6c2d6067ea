#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/scenario.h"

// What joint_trajectory_controller means by a goal that comes while another one is executed, one meaning a
// test, with drives of each kind (docs/motion.md).
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr double kNear = 1e-3;  // rad

class TakeOver : public testing::TestWithParam<KindOfArm> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
    const auto accepted = scenario.submit(all_to(0.8, 6.0));
    ASSERT_TRUE(accepted) << accepted.error().text;
    first = accepted.value().id;
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
    scenario.run(1.5);
  }

  static trajectory::Goal all_to(double position, double time) {
    return make_goal({time}, {std::vector<double>(6, position)});
  }

  void expect_to_stand_at(const std::vector<double>& positions) {
    scenario.run(0.3);
    for (std::size_t i = 0; i < positions.size(); ++i)
      EXPECT_NEAR(scenario.positions()[i], positions[i], kNear) << "joint" << i + 1;
  }

  void expect_the_first_goal_to_end_well() {
    const auto result = scenario.result_of(first);
    EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
    expect_to_stand_at(std::vector<double>(6, 0.8));
  }

  Scenario scenario{GetParam().arm("{allow_partial_joints_goal: true}")};
  motion::GoalId first = 0;
};

// Beside an arm that has no second goal.
TEST_P(TakeOver, AtItsStampAndTheOldMotionGoesOnUntilThen) {
  Scenario undisturbed(GetParam().arm("{allow_partial_joints_goal: true}"));
  ASSERT_TRUE(undisturbed.run_until_state(GroupState::Idle));
  ASSERT_TRUE(undisturbed.submit(all_to(0.8, 6.0)));
  ASSERT_TRUE(undisturbed.run_until_state(GroupState::Moving));
  undisturbed.run(1.5);

  trajectory::Goal goal = all_to(0.0, 3.0);
  goal.start = scenario.now() + host_duration(2.0);
  const auto second = scenario.submit(goal);
  ASSERT_TRUE(second) << second.error().text;
  EXPECT_NEAR(second.value().duration.count(), 5.0, 0.02);
  for (int i = 0; i < 19; ++i) {
    scenario.run(0.1);
    undisturbed.run(0.1);
    std::vector<trajectory::State> with;
    std::vector<trajectory::State> without;
    ASSERT_TRUE(scenario.driver().query(scenario.now(), with));
    ASSERT_TRUE(undisturbed.driver().query(undisturbed.now(), without));
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(with[j].position, without[j].position, kNear) << "joint" << j + 1 << " at " << i;
  }
  EXPECT_EQ(scenario.result_of(second.value().id).outcome, GoalOutcome::Succeeded);
  expect_to_stand_at(std::vector<double>(6, 0.0));
}

TEST_P(TakeOver, LeavesOutPointsThatLieInThePast) {
  trajectory::Goal goal = make_goal({0.1, 3.1}, {std::vector<double>(6, -3.0), std::vector<double>(6, 0.1)});
  goal.start = scenario.now() - host_duration(0.2);
  const auto second = scenario.submit(goal);
  ASSERT_TRUE(second) << second.error().text;
  EXPECT_FALSE(second.value().warnings.empty());
  EXPECT_EQ(scenario.result_of(second.value().id).outcome, GoalOutcome::Succeeded);
  expect_to_stand_at(std::vector<double>(6, 0.1));
}

TEST_P(TakeOver, IsRefusedWhenAllPointsLieInThePast) {
  trajectory::Goal goal = all_to(0.1, 1.0);
  goal.start = scenario.now() - host_duration(2.0);
  EXPECT_FALSE(scenario.submit(goal));
  expect_the_first_goal_to_end_well();
}

TEST_P(TakeOver, OfSomeJointsLetsTheOthersGoOn) {
  trajectory::Goal goal = make_goal({3.0}, {{-0.2}});
  goal.joint_names = {"joint2"};
  const auto second = scenario.submit(goal);
  ASSERT_TRUE(second) << second.error().text;
  EXPECT_EQ(scenario.result_of(first).outcome, GoalOutcome::Preempted);
  EXPECT_EQ(scenario.result_of(second.value().id).outcome, GoalOutcome::Succeeded);
  expect_to_stand_at({0.8, -0.2, 0.8, 0.8, 0.8, 0.8});
}

TEST_P(TakeOver, ThatIsNotPossibleIsRefusedAndNothingChanges) {
  const auto second = scenario.submit(all_to(-2.0, 0.9));
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().text.find("s at least"), std::string::npos) << second.error().text;
  expect_the_first_goal_to_end_well();
}

TEST_P(TakeOver, FromAStreamAndTheStreamFromTheGoal) {
  EXPECT_EQ(scenario.result_of(first).outcome, GoalOutcome::Succeeded);
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  const auto stream_to = [this](double position) {
    for (int i = 0; i < 60; ++i) {
      motion::Setpoint setpoint;
      setpoint.time = scenario.now();
      for (int j = 1; j <= 6; ++j) setpoint.joint_names.push_back("joint" + std::to_string(j));
      setpoint.positions.assign(6, position + 0.001 * i);
      setpoint.velocities.assign(6, 0.05);
      const auto refusal = scenario.driver().setpoint(setpoint, scenario.now());
      EXPECT_FALSE(refusal) << refusal->text;
      scenario.run(0.02);
    }
  };
  stream_to(0.8);
  ASSERT_EQ(scenario.state(), GroupState::Streaming);
  const auto goal = scenario.submit(all_to(0.3, 3.0));
  ASSERT_TRUE(goal) << goal.error().text;
  scenario.run(0.02);
  EXPECT_EQ(scenario.state(), GroupState::Moving);
  EXPECT_EQ(scenario.result_of(goal.value().id).outcome, GoalOutcome::Succeeded);
  EXPECT_EQ(scenario.state(), GroupState::Standing);
  stream_to(0.3);
  EXPECT_EQ(scenario.state(), GroupState::Streaming);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TakeOver, testing::ValuesIn(kKindsOfArms),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
