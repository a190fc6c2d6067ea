#include <string>

#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/setpoint_streaming.h"
#include "trajectory/random.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;

class GoalOverStream : public SetpointStreaming, public ::testing::WithParamInterface<KindOfArm> {
 protected:
  /// Setpoints of the sine until `end` (s since begin), a fifth of them lost, the others late by up to half a
  /// period; what is refused changes nothing.
  void go_on(double& t, double end) {
    for (; t < end; t += kPeriod) {
      const double late = random.uniform(0.0, kPeriod / 2.0);
      run(late);
      if (random.uniform(0.0, 1.0) >= 0.2) send(setpoint(begin + host_duration(t), position_at(t)));
      run(kPeriod - late);
    }
  }

  trajectory::Random random{7};
};

// A goal that comes at any instant of a stream whose setpoints go on coming: it takes over and ends where it
// is to end. From a few of them it would need more than the limits allow, and is refused.
TEST_P(GoalOverStream, TakesOver) {
  const int cases = trajectory::property_cases(6);
  int refusals = 0;
  start(GetParam().arm(""), 0.1);
  for (int i = 0; i < cases; ++i) {
    begin = scenario->now();
    double t = 0.0;
    go_on(t, random.uniform(0.3, 2.0));
    const auto goal = scenario->submit(make_goal({2.0}, {std::vector<double>(6, 0.0)}));
    if (!goal) {
      ++refusals;
      EXPECT_NE(goal.error().text.find("limit"), std::string::npos) << goal.error().text;
      run(2.0);
      continue;
    }
    go_on(t, t + 0.7);
    const auto result = scenario->result_of(goal.value().id);
    ASSERT_EQ(result.outcome, GoalOutcome::Succeeded) << i << ", " << t << " s: " << result.text;
    run(1.0);
    ASSERT_NEAR(scenario->positions()[3], 0.0, 2e-3) << i;
  }
  EXPECT_LE(refusals, cases / 3);
}

// Behind such a goal the drives are still under way for a moment, at rest: a first setpoint that is a jump
// moves nothing then, as it does later.
TEST_P(GoalOverStream, AndAJumpBehindItMovesNothing) {
  int jumps = 0;
  for (int k = 0; k < 8; ++k) {
    start(GetParam().arm(""), 0.1);
    begin = scenario->now();
    double t = 0.0;
    go_on(t, 1.3);
    const auto goal = scenario->submit(make_goal({2.0}, {std::vector<double>(6, 0.1)}));
    if (!goal) continue;
    go_on(t, 2.5);
    ASSERT_EQ(scenario->result_of(goal.value().id).outcome, GoalOutcome::Succeeded);
    run(0.15 * k);
    const auto before = scenario->state();
    send(setpoint(scenario->now(), 2.1));
    run(2.0);
    for (const double position : scenario->positions())
      EXPECT_NEAR(position, 0.1, 1e-3) << k << ": " << to_string(before);
    ++jumps;
  }
  EXPECT_GE(jumps, 4);
}

INSTANTIATE_TEST_SUITE_P(Kinds, GoalOverStream, ::testing::ValuesIn(kKindsOfArms),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
