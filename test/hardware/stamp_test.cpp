#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GroupState;

class Stamp : public ::testing::TestWithParam<KindOfArm> {
 protected:
  /// A goal whose time 0 is `ahead` s from now; when that was, by what the drives play.
  double late_by(double ahead) {
    trajectory::Goal goal = make_goal({0.5, 1.5}, {std::vector<double>(6, 0.2), std::vector<double>(6, 0.4)});
    goal.start = scenario_.now() + host_duration(ahead);
    const auto accepted = scenario_.submit(goal);
    EXPECT_TRUE(accepted) << accepted.error().text;
    if (!accepted) return NAN;
    const auto plays = [&] { return scenario_.snapshot().goal_time > GoalTime{0.3}; };
    EXPECT_TRUE(scenario_.run_until(plays, 10.0));
    return seconds(scenario_.now() - *goal.start) - scenario_.snapshot().goal_time.count();
  }

  Scenario scenario_{GetParam().arm("")};
};

// The lead that serial and cyclic drives need is taken before the stamp. EPOS drives begin at a SYNC: on a
// bus with cyclic drives that is the next one of the period.
TEST_P(Stamp, InTheFutureBeginsOnTime) {
  constexpr double kSyncPeriod = 0.010;  // s
  const bool waits_for_sync = GetParam().name == std::string("all_kinds");
  ASSERT_TRUE(scenario_.run_until_state(GroupState::Idle));
  EXPECT_NEAR(late_by(1.5), 0.0, 0.002 + (waits_for_sync ? kSyncPeriod : 0.0));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Stamp, ::testing::ValuesIn(kKindsOfArms),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
