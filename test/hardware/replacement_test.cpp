#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/random_moves.h"
#include "hardware/scenario.h"
#include "trajectory/random.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

/// And how long a goal is planned, ms; 0: on the spot.
class Replacement : public ::testing::TestWithParam<std::tuple<KindOfArm, int>> {
 protected:
  static const KindOfArm& kind() { return std::get<0>(GetParam()); }
  static HostDuration planning() { return std::chrono::milliseconds(std::get<1>(GetParam())); }

  Expected<motion::GoalAcceptance, Refusal> submit(const trajectory::Goal& goal) {
    if (planning() == HostDuration{0}) return scenario.submit(goal);
    scenario.driver().submit_later(std::make_shared<const trajectory::Goal>(goal), scenario.now());
    std::optional<hardware::GoalAnswer> answer;
    scenario.run_until([&] { return (answer = scenario.driver().take_goal_answer()).has_value(); }, 1.0);
    return answer ? answer->answer : Refusal{GoalError::InvalidGoal, "no answer"};
  }

  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
    scenario.driver().set_planning_time(planning());
    scenario.driver().set_motion_observer([this](std::size_t joint, const emulation::DemandSample& sample) {
      if (counts.empty()) return;
      watches[joint].take(seconds(sample.time.time_since_epoch()), sample.demand * counts[joint]);
    });
  }

  Scenario scenario{kind().arm("")};
  std::vector<double> counts;  ///< rad in one, of each joint
  std::vector<Watch> watches = std::vector<Watch>(6);
};

// Goals over goals at any instant: whatever is accepted in motion is joined without a stop, within the limits
// and to its end; whatever is refused changes nothing.
TEST_P(Replacement, IsOneMotion) {
  const int cases = trajectory::property_cases(40);
  trajectory::Random random(1);
  int joined = 0;
  double longest_wait = 0.0;
  auto goal = submit(random_goal(random, scenario.positions(), 0.6));
  ASSERT_TRUE(goal) << goal.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  for (const auto& joint : scenario.driver().report().joints) counts.push_back(joint.count);
  for (int i = 0; i < cases; ++i) {
    const double until = random.uniform(0.05, 0.8);
    scenario.run_until([&] { return scenario.state() != GroupState::Moving; }, until);
    const bool moving = scenario.state() == GroupState::Moving;
    const double left = (scenario.snapshot().goal_duration - scenario.snapshot().goal_time).count();
    auto next = submit(random_goal(random, scenario.positions(), 0.35));
    if (!next) continue;
    if (moving && left > 1.2) {
      EXPECT_EQ(scenario.state(), GroupState::Moving) << i;
      longest_wait = std::max(longest_wait, -scenario.snapshot().goal_time.count());
      EXPECT_EQ(scenario.result_of(goal.value().id, 0.02).outcome, GoalOutcome::Preempted) << i;
      ++joined;
    }
    goal = next;
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving)) << i << ": " << scenario.snapshot().fault;
  }
  const auto result = scenario.result_of(goal.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  EXPECT_GE(joined, cases / 4);
  double fastest = 0.0;
  double hardest = 0.0;
  for (const Watch& watch : watches) {
    fastest = std::max(fastest, watch.fastest());
    hardest = std::max(hardest, watch.hardest());
  }
  EXPECT_LE(fastest, 1.01 * kMaxVelocity);
  EXPECT_LE(hardest, 1.05 * kMaxAcceleration);
  for (const auto& joint : scenario.driver().report().joints)
    EXPECT_LE(joint.worst_deviation, 8.0) << joint.joint;
  std::printf("%s: %d of %d joined, %.2f s until the join at most, %.2f rad/s, %.2f rad/s^2\n", kind().name,
              joined, cases, longest_wait, fastest, hardest);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Replacement,
                         ::testing::Combine(::testing::ValuesIn(kKindsOfArms), ::testing::Values(0, 60)),
                         [](const auto& one) {
                           return std::string(std::get<0>(one.param).name) +
                                  (std::get<1>(one.param) == 0 ? "" : "_planned_meanwhile");
                         });

}  // namespace
}  // namespace interpolated_motion::test
