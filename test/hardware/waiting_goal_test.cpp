#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/scenario.h"

// Goals that are sent when the drives can no longer be told anything else, and wait until they rest.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

const std::vector<double> kThere(6, 0.3);
const std::vector<double> kBack(6, 0.25);

/// Through `kThere` to `kBack`, at rest in both.
trajectory::Goal there_and_back(double there, double back) {
  return make_goal({there, back}, {kThere, kBack},
                   {std::vector<double>(6, 0.0), std::vector<double>(6, 0.0)});
}

class WaitingGoal : public ::testing::TestWithParam<KindOfArm> {
 protected:
  void move(double for_seconds) {
    ASSERT_TRUE(scenario_.run_until_state(GroupState::Idle, 10.0)) << scenario_.snapshot().fault;
    const auto accepted =
        scenario_.submit(make_goal({0.0, 2.0}, {scenario_.positions(), std::vector<double>(6, 0.0)}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    first_ = accepted.value().id;
    ASSERT_TRUE(scenario_.run_until_state(GroupState::Moving));
    scenario_.run(for_seconds);
  }

  /// Sends `goal`, with a stamp that is `age` s old or without one, while the arm brakes.
  motion::GoalResult result_of_one_sent_in_braking(trajectory::Goal goal, std::optional<double> age = {}) {
    scenario_.driver().cancel(first_, scenario_.now());
    if (age) goal.start = scenario_.now() - host_duration(*age);
    const auto accepted = scenario_.submit(goal);
    if (!accepted) return {0, GoalOutcome::Aborted, accepted.error().code, accepted.error().text};
    return scenario_.result_of(accepted.value().id, 20.0);
  }

  void expect_all_at(double position) {
    for (const double actual : scenario_.positions()) EXPECT_NEAR(actual, position, 0.01);
  }

  Scenario scenario_{GetParam().arm("{}")};
  motion::GoalId first_ = 0;
};

// The time of its first point goes by while the arm brakes: there is no sense in giving up for that.
TEST_P(WaitingGoal, OfAStampIsMetLaterThanItIsDue) {
  move(1.0);
  const auto result = result_of_one_sent_in_braking(there_and_back(0.2, 0.4), 0.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  EXPECT_NE(result.text.find(" s late"), std::string::npos) << result.text;
  expect_all_at(kBack[0]);
}

// All of it goes by: it was accepted, and where it leads to is known.
TEST_P(WaitingGoal, OfAStampThatIsOverIsStillBroughtToItsEnd) {
  move(1.0);
  const auto result = result_of_one_sent_in_braking(
      make_goal({0.01, 0.05}, {kBack, kBack}, {std::vector<double>(6, 0.0), std::vector<double>(6, 0.0)}),
      0.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  EXPECT_NE(result.text.find(" s late"), std::string::npos) << result.text;
  expect_all_at(kBack[0]);
}

// Points with positions only, close to each other: what is left of the curve, half of which is past, is gone
// through as with the points that are left out. The arm comes to it from the other side.
TEST_P(WaitingGoal, OfAStampIsJoinedInTheMiddleOfItsCurve) {
  move(1.0);
  constexpr int kPoints = 60;
  std::vector<double> times;
  std::vector<std::vector<double>> positions;
  for (int i = 1; i <= kPoints; ++i) {
    const double part = static_cast<double>(i) / kPoints;
    const double to_go = 1.0 - part * part * part * (10.0 - 15.0 * part + 6.0 * part * part);
    times.push_back(1.2 * part);
    positions.emplace_back(6, kBack[0] + 0.35 * to_go);
  }
  const auto result = result_of_one_sent_in_braking(make_goal(times, positions), 0.55);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  expect_all_at(kBack[0]);
}

// Who plans while the arm brakes cannot know where it will rest.
TEST_P(WaitingGoal, SentWhileTheArmBrakesGoesWithoutItsFirstPoint) {
  move(0.8);
  const auto elsewhere = make_goal({0.0, 2.0}, {std::vector<double>(6, 1.0), kBack});
  const auto result = result_of_one_sent_in_braking(elsewhere);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  EXPECT_NE(result.text.find("were braking"), std::string::npos) << result.text;
  expect_all_at(kBack[0]);
  EXPECT_FALSE(scenario_.submit(elsewhere));  // at rest it is told
}

// Where the joints come to rest is not known then, and from outside a joint may move in: but this goal ends
// there.
TEST_P(WaitingGoal, BeyondALimitIsRefusedWhileTheArmBrakes) {
  move(1.0);
  scenario_.driver().halt(scenario_.now());
  ASSERT_EQ(scenario_.state(), GroupState::Stopping);
  const auto beyond = scenario_.submit(make_goal({1.0}, {std::vector<double>(6, 9.0)}));
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.error().text.find("position"), std::string::npos) << beyond.error().text;
}

// Within the limits, but with steps of acceleration at both ends: more than a cyclic drive makes smooth.
TEST_P(WaitingGoal, GetsAWayThatItsDrivesCanFollow) {
  move(1.0);
  const auto result =
      result_of_one_sent_in_braking(make_goal({0.32}, {kThere}, {std::vector<double>(6, 0.0)}));
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  expect_all_at(kThere[0]);
}

// Where the motion ends is known, so what is not possible from there is said at once, as it would be at rest:
// here a cubic near the limit of acceleration, which begins with a step of it. A cyclic drive interpolates
// beyond the limit then.
TEST_P(WaitingGoal, ThatIsNotPossibleFromTheEndIsRefusedWhenItIsSent) {
  move(0.0);
  ASSERT_TRUE(scenario_.run_until([this] { return scenario_.state() == GroupState::Settling; }, 5.0));
  const auto cubic = make_goal({0.303}, {kThere}, {std::vector<double>(6, 0.0)});
  const std::string kind = GetParam().name;
  const bool has_cyclic = kind == "cyclic" || kind == "all_kinds";
  const auto waiting = scenario_.submit(cubic);
  ASSERT_EQ(bool(waiting), !has_cyclic);
  if (waiting) {
    EXPECT_EQ(scenario_.result_of(waiting.value().id).outcome, GoalOutcome::Succeeded);
    return;
  }
  ASSERT_TRUE(scenario_.run_until_state(GroupState::Idle, 10.0));
  EXPECT_FALSE(scenario_.submit(cubic));
}

INSTANTIATE_TEST_SUITE_P(Kinds, WaitingGoal, ::testing::ValuesIn(kKindsOfArms),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
