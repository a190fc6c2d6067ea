#include <string>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

/// Lets the emulated world go on without the host.
void stall(Scenario& scenario, double duration) {
  scenario.driver().stall(scenario.now() + host_duration(duration));
}

TEST(HostAbsence, TheWorldGoesOnAndNobodyIsPolled) {
  Scenario scenario(arm_of(1));
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(make_goal({2.0}, {{1.0}}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Moving));
  scenario.run(0.8);
  const double before = *scenario.driver().emulated_position(0);
  const double told = scenario.positions()[0];
  stall(scenario, 0.2);
  EXPECT_GT(*scenario.driver().emulated_position(0), before + 0.05);
  EXPECT_EQ(scenario.positions()[0], told);
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, motion::GoalOutcome::Succeeded);
}

TEST(HostAbsence, OfAHostThatNeverComesBackTheDriveStopsByItself) {
  Scenario scenario(arm_of(1));
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Idle)) << scenario.snapshot().fault;
  ASSERT_TRUE(scenario.submit(make_goal({20.0}, {{3.0}})));
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Moving));
  scenario.run(2.0);
  stall(scenario, 5.0);
  const double rest = *scenario.driver().emulated_position(0);
  stall(scenario, 8.0);
  EXPECT_EQ(*scenario.driver().emulated_position(0), rest);
}

}  // namespace
}  // namespace interpolated_motion::test
