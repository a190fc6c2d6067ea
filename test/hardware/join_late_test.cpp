#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/scenario.h"

// A goal in the motion of another one whose first point cannot be reached in time (docs/motion.md).
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

const std::vector<double> kRest(6, 0.0);

/// Somewhere in a twentieth of a second, and to rest at 0.25 rad.
trajectory::Goal too_soon() {
  return make_goal({0.05, 3.0}, {std::vector<double>(6, -0.3), std::vector<double>(6, 0.25)}, {kRest, kRest});
}

class JoinLate : public ::testing::TestWithParam<KindOfArm> {
 protected:
  /// In the middle of a motion of all joints of 0.5 rad.
  void move(const std::string& changes) {
    scenario = std::make_unique<Scenario>(GetParam().arm(changes));
    ASSERT_TRUE(scenario->run_until_state(GroupState::Idle, 10.0)) << scenario->snapshot().fault;
    const auto accepted =
        scenario->submit(make_goal({1.0, 3.0}, {kRest, std::vector<double>(6, 0.5)}, {kRest, kRest}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    first = accepted.value().id;
    ASSERT_TRUE(scenario->run_until_state(GroupState::Moving));
    scenario->run(1.5);
  }

  std::unique_ptr<Scenario> scenario;
  motion::GoalId first = 0;
};

TEST_P(JoinLate, IsRefusedByDefaultWithTheTimeThatTheWayTakes) {
  move("{}");
  const auto refused = scenario->submit(too_soon());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("s at least"), std::string::npos) << refused.error().text;
  EXPECT_EQ(scenario->result_of(first).outcome, GoalOutcome::Succeeded);
}

TEST_P(JoinLate, MeetsAllPointsLater) {
  move("{join: late}");
  const auto late = scenario->submit(too_soon());
  ASSERT_TRUE(late) << late.error().text;
  ASSERT_EQ(late.value().warnings.size(), 1U);
  EXPECT_NE(late.value().warnings[0].find("s late"), std::string::npos) << late.value().warnings[0];
  const auto before = scenario->positions();
  double lowest = 1.0;
  while (scenario->state() != GroupState::Idle) {
    scenario->run(0.01);
    for (const double position : scenario->positions()) lowest = std::min(lowest, position);
    ASSERT_NE(scenario->state(), GroupState::Fault) << scenario->snapshot().fault;
  }
  EXPECT_EQ(scenario->result_of(late.value().id).outcome, GoalOutcome::Succeeded);
  EXPECT_GT(before[0], 0.0);
  EXPECT_NEAR(lowest, -0.3, 0.01);
  for (const double position : scenario->positions()) EXPECT_NEAR(position, 0.25, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Kinds, JoinLate, ::testing::ValuesIn(kKindsOfArms),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
