#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/kinds_of_arms.h"
#include "hardware/scenario.h"

// Goals that are planned while the drives go on.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr HostDuration kPlanning = std::chrono::milliseconds(200);
const std::vector<double> kRest(6, 0.0);

motion::GoalPtr shared(trajectory::Goal goal) {
  return std::make_shared<const trajectory::Goal>(std::move(goal));
}

trajectory::Goal to(double position, double time) {
  return make_goal({time}, {std::vector<double>(6, position)}, {kRest});
}

class PlannedMeanwhile : public ::testing::TestWithParam<KindOfArm> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scenario_.run_until_state(GroupState::Idle)) << scenario_.snapshot().fault;
    driver().set_planning_time(kPlanning);
  }

  hardware::MotionHardware& driver() { return scenario_.driver(); }

  hardware::Ticket hand_in(trajectory::Goal goal) {
    return driver().submit_later(shared(std::move(goal)), scenario_.now());
  }

  /// Runs until the next goal is answered.
  hardware::GoalAnswer answer(double patience = 5.0) {
    std::optional<hardware::GoalAnswer> answer;
    scenario_.run_until([&] { return (answer = driver().take_goal_answer()).has_value(); }, patience);
    EXPECT_TRUE(answer) << "no answer within " << patience << " s";
    return answer ? *answer : hardware::GoalAnswer{0, nullptr, Refusal{}};
  }

  motion::GoalId accepted(trajectory::Goal goal) {
    const hardware::Ticket ticket = hand_in(std::move(goal));
    const hardware::GoalAnswer answered = answer();
    EXPECT_EQ(answered.ticket, ticket);
    EXPECT_TRUE(answered.answer) << answered.answer.error().text;
    return answered.answer ? answered.answer.value().id : 0;
  }

  /// A goal that has moved the arm for so long.
  motion::GoalId under_way(trajectory::Goal goal, double for_seconds) {
    const motion::GoalId id = accepted(std::move(goal));
    EXPECT_TRUE(scenario_.run_until_state(GroupState::Moving));
    scenario_.run(for_seconds);
    return id;
  }

  void expect_success(motion::GoalId id) {
    const motion::GoalResult result = scenario_.result_of(id);
    EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  }

  void expect_at(double position) {
    for (const double actual : scenario_.positions()) EXPECT_NEAR(actual, position, 0.01);
  }

  Scenario scenario_{GetParam().arm("")};
};

// Idle cyclic drives fault when they are left without target positions for a few periods.
TEST_P(PlannedMeanwhile, FromRestTheGoalBeginsWhenItIsPlanned) {
  const HostTime sent = scenario_.now();
  const auto id = accepted(to(0.5, 1.0));
  EXPECT_GE(scenario_.now() - sent, kPlanning);
  expect_success(id);
  expect_at(0.5);
}

TEST_P(PlannedMeanwhile, InMotionTheFormerGoalGoesOnUntilThen) {
  const auto first = under_way(to(1.0, 2.0), 0.4);
  const HostTime sent = scenario_.now();
  const auto second = accepted(to(-0.5, 6.0));
  EXPECT_GE(scenario_.now() - sent, kPlanning);
  EXPECT_EQ(scenario_.state(), GroupState::Moving);
  EXPECT_EQ(scenario_.result_of(first, 0.1).outcome, GoalOutcome::Preempted);
  expect_success(second);
  expect_at(-0.5);
}

TEST_P(PlannedMeanwhile, AHaltCountsForGoalsSentBefore) {
  hand_in(to(0.5, 1.0));
  scenario_.run(0.1);
  driver().halt(scenario_.now());
  const auto answered = answer();
  ASSERT_FALSE(answered.answer);
  EXPECT_NE(answered.answer.error().text.find("stopped while"), std::string::npos);
  scenario_.run(1.0);
  expect_at(0.0);
  expect_success(accepted(to(0.5, 1.0)));
}

TEST_P(PlannedMeanwhile, AStopDoesNotWaitForPlanning) {
  const auto first = under_way(to(1.0, 3.0), 0.5);
  const auto planned = hand_in(to(-1.0, 5.0));
  trajectory::Goal stop = to(0.0, 1.0);
  stop.points.clear();
  const auto stopped = hand_in(stop);
  const auto first_answer = answer(0.001);
  EXPECT_EQ(first_answer.ticket, stopped);
  ASSERT_TRUE(first_answer.answer);
  EXPECT_EQ(scenario_.state(), GroupState::Stopping);
  const auto second_answer = answer();
  EXPECT_EQ(second_answer.ticket, planned);
  EXPECT_FALSE(second_answer.answer);
  EXPECT_EQ(scenario_.result_of(first).outcome, GoalOutcome::Preempted);
  expect_success(first_answer.answer.value().id);
}

TEST_P(PlannedMeanwhile, OfGoalsThatWaitForPlanningTheNewestCounts) {
  const auto first = hand_in(to(0.2, 1.0));
  const auto second = hand_in(to(0.4, 1.0));
  const auto third = hand_in(to(0.6, 2.0));
  const auto replaced = answer();
  EXPECT_EQ(replaced.ticket, second);
  ASSERT_FALSE(replaced.answer);
  EXPECT_NE(replaced.answer.error().text.find("newer goal"), std::string::npos);
  EXPECT_EQ(answer().ticket, first);
  const auto newest = answer();
  EXPECT_EQ(newest.ticket, third);
  ASSERT_TRUE(newest.answer) << newest.answer.error().text;
  expect_success(newest.answer.value().id);
  expect_at(0.6);
}

TEST_P(PlannedMeanwhile, AGoalIsWithdrawn) {
  const auto first = hand_in(to(0.2, 1.0));
  const auto second = hand_in(to(0.4, 1.0));
  driver().withdraw(second, scenario_.now());
  driver().withdraw(first, scenario_.now());
  EXPECT_FALSE(answer().answer);
  EXPECT_FALSE(answer().answer);
  scenario_.run(1.0);
  EXPECT_FALSE(driver().take_goal_answer());
  expect_at(0.0);
  expect_success(accepted(to(0.5, 1.0)));
}

TEST_P(PlannedMeanwhile, AGoalThatIsRefusedChangesNothing) {
  const auto first = under_way(to(1.0, 2.0), 0.4);
  hand_in(to(9.0, 2.0));
  const auto refused = answer();
  ASSERT_FALSE(refused.answer);
  EXPECT_NE(refused.answer.error().text.find("joint1"), std::string::npos) << refused.answer.error().text;
  expect_success(first);
  expect_at(1.0);
}

TEST_P(PlannedMeanwhile, AGoalThatWaitedForRestIsPlannedThere) {
  const auto first = under_way(to(1.0, 3.0), 1.0);
  driver().cancel(first, scenario_.now());
  const auto second = accepted(to(0.3, 2.0));
  expect_success(second);
  expect_at(0.3);
}

TEST_P(PlannedMeanwhile, AHaltCountsForAGoalThatWaitedForRest) {
  const auto first = under_way(to(1.0, 3.0), 1.0);
  driver().set_planning_time(std::chrono::milliseconds(10));
  driver().cancel(first, scenario_.now());
  const auto second = accepted(to(0.3, 2.0));
  driver().set_planning_time(std::chrono::seconds(1));
  ASSERT_TRUE(scenario_.run_until_state(GroupState::Idle));
  scenario_.run(0.5);
  const auto before = scenario_.positions();
  driver().halt(scenario_.now());
  EXPECT_EQ(scenario_.result_of(second, 1.0).outcome, GoalOutcome::Aborted);
  scenario_.run(2.0);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(scenario_.positions()[i], before[i], 1e-3);
}

TEST_P(PlannedMeanwhile, SetpointsAreTakenAgainWhenTheGoalHasEnded) {
  motion::Setpoint setpoint;
  for (int i = 1; i <= 6; ++i) setpoint.joint_names.push_back("joint" + std::to_string(i));
  setpoint.positions = std::vector<double>(6, 0.05);
  setpoint.source = "test";
  const auto stream = [&](double for_seconds) {
    std::optional<Refusal> last;
    const HostTime end = scenario_.now() + host_duration(for_seconds);
    while (scenario_.now() < end) {
      setpoint.time = scenario_.now();
      last = driver().setpoint(setpoint, scenario_.now());
      scenario_.run(0.05);
    }
    return last;
  };
  EXPECT_FALSE(stream(1.0));
  hand_in(to(0.5, 3.0));
  const auto refused = stream(0.1);
  ASSERT_TRUE(refused);
  EXPECT_NE(refused->text.find("goal"), std::string::npos);
  const auto answered = answer();
  ASSERT_TRUE(answered.answer) << answered.answer.error().text;
  expect_success(answered.answer.value().id);
  expect_at(0.5);
  setpoint.positions = std::vector<double>(6, 0.5);
  EXPECT_FALSE(stream(1.0));
}

// The drives of a stream that has just begun still stand when planning begins, and move when it ends.
TEST_P(PlannedMeanwhile, AStreamBegunMeanwhileIsJoined) {
  hand_in(to(0.5, 3.0));
  motion::Setpoint setpoint;
  for (int i = 1; i <= 6; ++i) setpoint.joint_names.push_back("joint" + std::to_string(i));
  setpoint.source = "test";
  std::optional<hardware::GoalAnswer> answered;
  for (int i = 0; i < 200 && !answered; ++i) {
    setpoint.time = scenario_.now();
    setpoint.positions = std::vector<double>(6, 0.003 * i);
    driver().setpoint(setpoint, scenario_.now());
    scenario_.run(0.02);
    answered = driver().take_goal_answer();
  }
  ASSERT_TRUE(answered && answered->answer);
  expect_success(answered->answer.value().id);
  expect_at(0.5);
}

// A planner on a thread of its own takes what time it takes: what joins too late is planned once more.
TEST_P(PlannedMeanwhile, PlanningThatTakesLongerThanAllowedIsDoneAgain) {
  constexpr double kTaken = 0.8;  // s, more than any drive is committed ahead
  const auto first = under_way(to(1.0, 12.0), 0.5);
  std::vector<motion::PlanningPtr> given;
  driver().set_planner([&](motion::PlanningPtr planning) { given.push_back(std::move(planning)); });
  const auto ticket = hand_in(to(-0.5, 12.0));
  std::optional<hardware::GoalAnswer> answered;
  while (!answered && given.size() < 10) {
    const motion::PlanningPtr planning = given.back();
    planning->run();
    scenario_.run(kTaken);
    driver().planned(*planning, host_duration(kTaken), scenario_.now());
    answered = driver().take_goal_answer();
  }
  ASSERT_TRUE(answered);
  EXPECT_EQ(answered->ticket, ticket);
  ASSERT_TRUE(answered->answer) << answered->answer.error().text;
  EXPECT_EQ(given.size(), 2U);
  EXPECT_EQ(scenario_.state(), GroupState::Moving);
  EXPECT_EQ(scenario_.result_of(first, 0.1).outcome, GoalOutcome::Preempted);
  expect_success(answered->answer.value().id);
  expect_at(-0.5);
}

TEST_P(PlannedMeanwhile, AFaultRefusesTheGoal) {
  driver().set_planning_time(std::chrono::seconds(4));
  hand_in(to(0.5, 1.0));
  std::string reason;
  ASSERT_TRUE(driver().inject("joint1", "power_cycle 1", &reason, scenario_.now())) << reason;
  ASSERT_TRUE(scenario_.run_until_state(GroupState::Fault, 3.0));
  const auto refused = answer();
  ASSERT_FALSE(refused.answer);
  EXPECT_NE(refused.answer.error().text.find("joint1"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PlannedMeanwhile, ::testing::ValuesIn(kKindsOfArms),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
