#include <algorithm>
#include <cmath>
#include <cstdio>
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

// Pause, resume, speed override and stops on the path, of all kinds of drives, with goals and speeds that are
// planned on the spot or meanwhile.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;
using motion::SpeedOrder;

const SpeedOrder kPause{std::nullopt, true};
const SpeedOrder kResume{std::nullopt, false};
SpeedOrder at(double rate) { return {rate, std::nullopt}; }

/// Counts that a drive's demand may be off the course: what its records are certified for, and of cyclic
/// drives what their interpolation makes of a changing acceleration.
constexpr double kBound = 8.0;

/// And how long planning takes, ms; 0: it is done on the spot.
class Speed : public ::testing::TestWithParam<std::tuple<KindOfArm, int>> {
 protected:
  static const KindOfArm& kind() { return std::get<0>(GetParam()); }

  explicit Speed(const std::string& changes = "") : scenario(kind().arm(changes)) {}

  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
    scenario.driver().set_planning_time(std::chrono::milliseconds(std::get<1>(GetParam())));
    scenario.driver().set_motion_observer([this](std::size_t joint, const emulation::DemandSample& sample) {
      if (counts.empty()) return;
      watches[joint].take(seconds(sample.time.time_since_epoch()), sample.demand * counts[joint]);
    });
  }

  Expected<motion::GoalAcceptance, Refusal> submit(const trajectory::Goal& goal) {
    scenario.driver().submit_later(std::make_shared<const trajectory::Goal>(goal), scenario.now());
    std::optional<hardware::GoalAnswer> answer;
    scenario.run_until([&] { return (answer = scenario.driver().take_goal_answer()).has_value(); }, 1.0);
    return answer ? answer->answer : Refusal{GoalError::InvalidGoal, "no answer"};
  }

  /// All joints by so many rad, each in its own measure of that, in `duration` s, rest to rest.
  trajectory::Goal move(double by, double duration) {
    trajectory::Goal goal;
    trajectory::Waypoint point;
    const std::vector<double> present = scenario.positions();
    for (std::size_t i = 0; i < present.size(); ++i) {
      goal.joint_names.push_back("joint" + std::to_string(i + 1));
      point.positions.push_back(present[i] + by * (1.0 - 0.1 * static_cast<double>(i)));
    }
    point.time = GoalTime{duration};
    point.velocities.assign(present.size(), 0.0);
    point.accelerations.assign(present.size(), 0.0);
    goal.points = {point};
    target = point.positions;
    return goal;
  }

  void begin(const trajectory::Goal& goal) {
    const auto accepted = submit(goal);
    ASSERT_TRUE(accepted) << accepted.error().text;
    id = accepted.value().id;
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
    for (const auto& joint : scenario.driver().report().joints) counts.push_back(joint.count);
  }

  void order(const SpeedOrder& order) {
    const auto refused = scenario.driver().order_speed(order, scenario.now());
    EXPECT_FALSE(refused) << refused->text;
  }

  double moved_in(double duration) {
    const auto before = scenario.positions();
    scenario.run(duration);
    double most = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i)
      most = std::max(most, std::abs(scenario.positions()[i] - before[i]));
    return most;
  }

  /// All joints have gone the same part of their ways, but for so many rad: of joint1's way.
  double off_the_way() {
    const auto now = scenario.positions();
    const double part = 1.0 - (target[0] - now[0]) / kDistance;
    double most = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double whole = kDistance * (1.0 - 0.1 * static_cast<double>(i));
      most = std::max(most, std::abs(now[i] - (target[i] - (1.0 - part) * whole)));
    }
    return most;
  }

  void expect_success() {
    const auto result = scenario.result_of(id);
    EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
    for (std::size_t i = 0; i < target.size(); ++i) EXPECT_NEAR(scenario.positions()[i], target[i], 2e-3);
  }

  void expect_limits_kept() {
    for (const Watch& watch : watches) {
      EXPECT_LE(watch.fastest(), 1.01 * kMaxVelocity);
      EXPECT_LE(watch.hardest(), 1.05 * kMaxAcceleration);
    }
    for (const auto& joint : scenario.driver().report().joints)
      EXPECT_LE(joint.worst_deviation, kBound) << joint.joint;
  }

  static constexpr double kDistance = 1.2;  // rad
  Scenario scenario;
  std::vector<double> counts;  ///< rad in one, of each joint
  std::vector<Watch> watches = std::vector<Watch>(6);
  std::vector<double> target;
  motion::GoalId id = 0;
};

TEST_P(Speed, IsPausedOnTheWayAndResumed) {
  begin(move(kDistance, 3.0));
  scenario.run(1.2);
  const HostTime asked = scenario.now();
  order(kPause);
  EXPECT_TRUE(scenario.snapshot().speed.paused);
  ASSERT_TRUE(scenario.run_until([&] { return scenario.snapshot().speed.rate == 0.0; }, 3.0));
  const double to_rest = seconds(scenario.now() - asked);
  scenario.run(0.2);
  EXPECT_LT(moved_in(5.0), 1e-3);  // the drives have left their interpolation meanwhile
  EXPECT_LT(off_the_way(), 1e-3);
  EXPECT_GT(target[0] - scenario.positions()[0], 0.1);
  EXPECT_EQ(scenario.snapshot().active_goal, id);
  order(kResume);
  expect_success();
  expect_limits_kept();
  std::printf("%s: at rest %.2f s after the pause was asked for\n", kind().name, to_rest);
}

TEST_P(Speed, IsResumedBeforeTheDrivesHaveLeft) {
  begin(move(kDistance, 3.0));
  scenario.run(1.2);
  order(kPause);
  ASSERT_TRUE(scenario.run_until([&] { return scenario.snapshot().speed.rate == 0.0; }, 3.0));
  scenario.run(0.3);
  order(kResume);
  expect_success();
  expect_limits_kept();
}

TEST_P(Speed, IsOverriddenInMotion) {
  for (const double rate : {0.1, 0.5, 2.0}) {
    counts.clear();
    order(at(1.0));
    begin(move(rate < 1.0 ? kDistance : -kDistance, 3.0));
    scenario.run(0.8);
    order(at(rate));
    ASSERT_TRUE(scenario.run_until([&] { return scenario.snapshot().speed.rate == rate; }, 3.0)) << rate;
    const double left = (scenario.snapshot().goal_duration - scenario.snapshot().goal_time).count();
    const HostTime begun = scenario.now();
    expect_success();
    // Besides settling, and what SilverLode drives need to be known at rest.
    const double took = seconds(scenario.now() - begun);
    EXPECT_GE(took, left / rate - 0.05);
    EXPECT_LE(took, left / rate + 1.2);
    expect_limits_kept();
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  }
}

TEST_P(Speed, HoldsForGoalsFromRest) {
  order(at(0.5));
  const auto accepted = submit(move(kDistance, 1.5));
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_NEAR(accepted.value().duration.count(), 3.0, 0.1);
  id = accepted.value().id;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  const HostTime begun = scenario.now();
  EXPECT_EQ(scenario.snapshot().speed.rate, 0.5);
  expect_success();
  EXPECT_GE(seconds(scenario.now() - begun), 2.9);
  for (const auto& joint : scenario.driver().report().joints) EXPECT_LE(joint.worst_deviation, kBound);
}

TEST_P(Speed, IsNoMoreThanTheLimitsAllow) {
  order(at(2.0));
  // A quintic's fastest is 15/8 of its mean: at rate 1 two thirds of the velocity limit.
  begin(move(kDistance, 1.875 * kDistance / (0.67 * kMaxVelocity)));
  expect_success();
  expect_limits_kept();
}

TEST_P(Speed, LetsNoGoalBeginWhilePaused) {
  order(kPause);
  const auto accepted = submit(move(kDistance, 2.0));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_EQ(accepted.value().warnings.size(), 1u);
  EXPECT_NE(accepted.value().warnings[0].find("~resume"), std::string::npos);
  id = accepted.value().id;
  EXPECT_LT(moved_in(2.0), 1e-3);
  EXPECT_EQ(scenario.state(), GroupState::Idle);
  EXPECT_EQ(scenario.snapshot().active_goal, id);
  order(kResume);
  expect_success();
}

TEST_P(Speed, IsZeroWhenTheOverrideIs) {
  begin(move(kDistance, 2.0));
  scenario.run(0.7);
  order(at(0.0));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle, 5.0));
  EXPECT_LT(moved_in(1.0), 1e-3);
  order(kResume);
  EXPECT_LT(moved_in(1.0), 1e-3);
  order(at(1.0));
  expect_success();
}

// While it stands, and while it comes to stand.
TEST_P(Speed, LetsAPausedGoalBeReplaced) {
  for (const double after : {0.05, 0.6, 3.0}) {
    counts.clear();
    begin(move(kDistance, 2.0));
    scenario.run(0.7);
    order(kPause);
    scenario.run(after);
    const auto next = submit(move(-0.5 * kDistance, 2.0));
    ASSERT_TRUE(next) << next.error().text;
    EXPECT_EQ(scenario.result_of(id, 3.0).outcome, GoalOutcome::Preempted);
    id = next.value().id;
    scenario.run(2.0);
    EXPECT_LT(moved_in(2.0), 1e-3);
    order(kResume);
    expect_success();
    expect_limits_kept();
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  }
}

TEST_P(Speed, LetsAPausedGoalBeEnded) {
  for (const bool halt : {false, true}) {
    counts.clear();
    order(kResume);
    begin(move(kDistance, 2.0));
    scenario.run(0.7);
    order(kPause);
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle, 5.0));
    if (halt) {
      scenario.driver().halt(scenario.now());
    } else {
      scenario.driver().cancel(id, scenario.now());
    }
    EXPECT_EQ(scenario.result_of(id, 0.1).outcome, halt ? GoalOutcome::Aborted : GoalOutcome::Preempted);
    order(kResume);
    EXPECT_LT(moved_in(1.0), 1e-3);
  }
}

TEST_P(Speed, LetsNoSetpointBeTakenWhilePaused) {
  order(kPause);
  motion::Setpoint setpoint;
  setpoint.time = scenario.now();
  setpoint.source = "test";
  for (std::size_t i = 0; i < 6; ++i) {
    setpoint.joint_names.push_back("joint" + std::to_string(i + 1));
    setpoint.positions.push_back(scenario.positions()[i]);
  }
  EXPECT_TRUE(scenario.driver().setpoint(setpoint, scenario.now()));
  order(kResume);
  EXPECT_FALSE(scenario.driver().setpoint(setpoint, scenario.now()));
}

TEST_P(Speed, OutOfRangeIsRefused) {
  for (const double rate : {-0.1, 2.01, std::nan("")}) {
    const auto refused = scenario.driver().order_speed(at(rate), scenario.now());
    ASSERT_TRUE(refused);
    EXPECT_NE(refused->text.find("allowed is 0 (a pause) to 2"), std::string::npos);
  }
  EXPECT_EQ(scenario.snapshot().speed.override_rate, 1.0);
}

// Whatever is asked for at whatever instant: within the limits, and all goals end as they should.
TEST_P(Speed, ChangesAtRandomAreOneMotion) {
  trajectory::Random random(3);
  const int cases = trajectory::property_cases(12);
  begin(random_goal(random, scenario.positions(), 0.5));
  for (int i = 0; i < cases; ++i) {
    for (int change = random.integer(1, 4); change > 0; --change) {
      scenario.run(random.uniform(0.0, 0.7));
      order(random.integer(0, 3) == 0 ? kPause : kResume);
      order(at(random.integer(0, 4) == 0 ? 0.0 : random.uniform(0.05, 2.0)));
    }
    order(kResume);
    order(at(random.uniform(0.3, 2.0)));
    if (random.integer(0, 1) == 0) {
      const auto result = scenario.result_of(id);
      ASSERT_EQ(result.outcome, GoalOutcome::Succeeded) << i << ": " << result.text;
      ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << i;
      const auto next = submit(random_goal(random, scenario.positions(), 0.5));
      ASSERT_TRUE(next) << i << ": " << next.error().text;
      id = next.value().id;
    } else if (const auto next = submit(random_goal(random, scenario.positions(), 0.3))) {
      const auto result = scenario.result_of(id);
      ASSERT_NE(result.outcome, GoalOutcome::Aborted) << i << ": " << result.text;
      id = next.value().id;
    }
  }
  const auto result = scenario.result_of(id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  target.clear();
  expect_limits_kept();
}

class StopOnPath : public Speed {
 protected:
  StopOnPath() : Speed("stop_trajectory_duration: 0.5") {}
};

TEST_P(StopOnPath, ComesToRestOnTheWay) {
  for (const bool by_cancel : {true, false}) {
    counts.clear();
    begin(move(kDistance, 3.0));
    scenario.run(1.2);
    const HostTime asked = scenario.now();
    motion::GoalId stop = 0;
    if (by_cancel) {
      scenario.driver().cancel(id, scenario.now());
    } else {
      trajectory::Goal empty;
      for (std::size_t i = 1; i <= target.size(); ++i)
        empty.joint_names.push_back("joint" + std::to_string(i));
      const auto accepted = submit(empty);
      ASSERT_TRUE(accepted);
      stop = accepted.value().id;
    }
    const auto result = scenario.result_of(id, 5.0);
    EXPECT_EQ(result.outcome, GoalOutcome::Preempted) << result.text;
    std::printf("%s: at rest %.2f s after it was cancelled\n", kind().name, seconds(scenario.now() - asked));
    if (!by_cancel) {
      EXPECT_EQ(scenario.result_of(stop, 1.0).outcome, GoalOutcome::Succeeded);
    }
    scenario.run(0.2);  // the drives still play the end of their records, within their bound
    EXPECT_LT(moved_in(1.5), 1e-3);
    EXPECT_LT(off_the_way(), 1e-3);
    expect_limits_kept();
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  }
  counts.clear();
  begin(move(-kDistance, 2.0));
  expect_success();
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<KindOfArm, int>>& one) {
  return std::string(std::get<0>(one.param).name) + (std::get<1>(one.param) == 0 ? "" : "_planned_meanwhile");
}

INSTANTIATE_TEST_SUITE_P(Kinds, Speed,
                         ::testing::Combine(::testing::ValuesIn(kKindsOfArms), ::testing::Values(0, 60)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Kinds, StopOnPath,
                         ::testing::Combine(::testing::ValuesIn(kKindsOfArms), ::testing::Values(0)),
                         name_of);

}  // namespace
}  // namespace interpolated_motion::test
