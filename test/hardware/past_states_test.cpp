#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GroupState;

class PastStates : public ::testing::TestWithParam<KindOfArm> {
 protected:
  std::vector<trajectory::State> desired(HostTime time) {
    std::vector<trajectory::State> states;
    EXPECT_TRUE(scenario_.driver().query(time, states));
    return states;
  }

  Scenario scenario_{GetParam().arm("")};
};

// What was desired is told long after the motion has ended as it was told then.
TEST_P(PastStates, AreToldForAMinute) {
  ASSERT_TRUE(scenario_.run_until_state(GroupState::Idle));
  const auto goal = make_goal({1.0, 2.0}, {std::vector<double>(6, 0.8), std::vector<double>(6, 0.0)});
  const auto accepted = scenario_.submit(goal);
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario_.run_until_state(GroupState::Moving));
  std::vector<HostTime> times;
  std::vector<std::vector<trajectory::State>> told;
  for (int i = 0; i < 250; ++i) {
    scenario_.run(0.0077);
    times.push_back(scenario_.now());
    told.push_back(desired(scenario_.now()));
  }
  EXPECT_EQ(scenario_.result_of(accepted.value().id).outcome, motion::GoalOutcome::Succeeded);
  scenario_.run(50.0);
  double fastest = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto states = desired(times[i]);
    for (std::size_t j = 0; j < states.size(); ++j) {
      EXPECT_NEAR(states[j].position, told[i][j].position, 1e-4) << i;
      EXPECT_NEAR(states[j].velocity, told[i][j].velocity, 0.05) << i;
      fastest = std::max(fastest, std::abs(states[j].velocity));
    }
  }
  EXPECT_GT(fastest, 0.5);
  scenario_.run(12.0);
  std::vector<trajectory::State> states;
  EXPECT_FALSE(scenario_.driver().query(times.front(), states)) << "more than a minute ago";
}

INSTANTIATE_TEST_SUITE_P(Kinds, PastStates, ::testing::ValuesIn(kKindsOfArms),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
