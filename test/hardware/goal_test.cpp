#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

class PlannerGoal : public ::testing::TestWithParam<const char*> {};

TEST_P(PlannerGoal, IsPlayedWithinOneCountAtEveryDriveSample) {
  Scenario scenario;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(load_goal(goal_file(GetParam())));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  const auto report = scenario.driver().report();
  for (const auto& joint : report.joints) {
    EXPECT_LE(joint.worst_deviation, 1.0) << joint.joint;
    EXPECT_LE(joint.final_deviation, 1.0) << joint.joint;
    EXPECT_EQ(joint.underruns, 0u) << joint.joint;
    EXPECT_GE(static_cast<double>(joint.samples), accepted.value().duration.count() * 1000.0) << joint.joint;
    EXPECT_GE(joint.minimum_fill, 2u) << joint.joint;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, PlannerGoal,
                         ::testing::Values("six_axis_toppra_100ms_pv.yaml", "six_axis_toppra_100ms_pva.yaml",
                                           "six_axis_toppra_20ms_pva.yaml"),
                         [](const ::testing::TestParamInfo<const char*>& file) {
                           const std::string name = file.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace interpolated_motion::test
