#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

void expect_followed(Scenario& scenario, double bound, double final_bound) {
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_GT(joint.samples, 0U) << joint.joint;
    EXPECT_LE(joint.worst_deviation, bound) << joint.joint;
    EXPECT_LE(joint.final_deviation, final_bound) << joint.joint;
    EXPECT_EQ(joint.underruns, 0U) << joint.joint;
  }
}

class SilverlodeGoals : public testing::TestWithParam<const char*> {};

TEST_P(SilverlodeGoals, AreFollowedAtEveryServoTick) {
  Scenario scenario(six_axis_silverlode());
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(load_goal(goal_file(GetParam())));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, motion::GoalOutcome::Succeeded) << result.text;
  expect_followed(scenario, 2.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Planned, SilverlodeGoals,
                         testing::Values("six_axis_toppra_100ms_pv.yaml", "six_axis_toppra_100ms_pva.yaml",
                                         "six_axis_toppra_20ms_pva.yaml"));

}  // namespace
}  // namespace interpolated_motion::test
