#pragma once

#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// An arm in the middle of a planner's goal.
class FaultInMotion : public ::testing::Test {
 protected:
  static constexpr double kAcceleration =
      20.0;  ///< rad/s^2, limit of the arm and so the drives' deceleration

  void move(const YAML::Node& parameters = six_axis(), double for_seconds = 2.0) {
    scenario = std::make_unique<Scenario>(parameters);
    ASSERT_TRUE(scenario->run_until_state(motion::GroupState::Idle)) << scenario->snapshot().fault;
    const auto accepted = scenario->submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
    ASSERT_TRUE(accepted) << accepted.error().text;
    goal = accepted.value().id;
    ASSERT_TRUE(scenario->run_until_state(motion::GroupState::Moving));
    scenario->run(for_seconds);
    ASSERT_EQ(scenario->state(), motion::GroupState::Moving);
  }

  void inject(const std::string& target, const std::string& command) {
    std::string reason;
    ASSERT_TRUE(scenario->driver().inject(target, command, &reason, scenario->now())) << reason;
  }

  /// The goal ends as Aborted with `text`, and all joints that still obey come to rest within the distance
  /// their deceleration needs, plus what they travel until the fault is noticed.
  void expect_stop(const std::string& text, double notice = 0.05, int dead_joint = -1) {
    const auto before = scenario->snapshot();
    const auto result = scenario->result_of(goal);
    EXPECT_EQ(result.outcome, motion::GoalOutcome::Aborted);
    EXPECT_TRUE(contains(result.text, text)) << result.text;
    EXPECT_EQ(scenario->state(), motion::GroupState::Fault);
    const auto told = scenario->positions();
    scenario->run(0.5);
    const auto rest = scenario->positions();
    scenario->run(1.0);
    const auto later = scenario->positions();
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (static_cast<int>(i) == dead_joint) continue;
      EXPECT_NEAR(told[i], rest[i], 2e-4) << "joint" << i + 1 << " is told to rest where it does not";
      EXPECT_NEAR(later[i], rest[i], 2e-4) << "joint" << i + 1 << " does not rest";
      const double speed = 3.5;
      const double reach = std::abs(before.joints[i].actual.velocity) * notice +
                           0.5 * kAcceleration * notice * notice + speed * speed / (2.0 * kAcceleration);
      EXPECT_LE(std::abs(rest[i] - before.joints[i].actual.position), reach) << "joint" << i + 1;
    }
  }

  /// After ~reset_faults and ~enable nothing moves until a new goal comes, and that one works.
  void expect_recovery() {
    const auto reset = scenario->result_of_request(scenario->driver().reset_faults(scenario->now()));
    ASSERT_TRUE(reset.success) << reset.message;
    EXPECT_EQ(scenario->state(), motion::GroupState::Disabled);
    const auto before = scenario->positions();
    const auto enabled = scenario->result_of_request(scenario->driver().enable(true, scenario->now()));
    ASSERT_TRUE(enabled.success) << enabled.message;
    scenario->run(3.0);
    const auto after = scenario->positions();
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_NEAR(after[i], before[i], 1e-3) << "joint" << i + 1;
    std::vector<double> target = after;
    for (double& position : target) position += 0.2;
    const auto accepted = scenario->submit(make_goal({1.0}, {target}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    const auto result = scenario->result_of(accepted.value().id);
    EXPECT_EQ(result.outcome, motion::GoalOutcome::Succeeded) << result.text;
    EXPECT_NEAR(scenario->positions()[3], target[3], 1e-4);
  }

  std::unique_ptr<Scenario> scenario;
  motion::GoalId goal = 0;
};

}  // namespace interpolated_motion::test
