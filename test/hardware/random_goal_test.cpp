#include <cmath>

#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "trajectory/random.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

trajectory::Goal random_goal(trajectory::Random& random, int joints, const std::vector<double>& start) {
  const int points = random.integer(1, 12);
  const bool with_velocities = random.integer(0, 1) == 1;
  std::vector<double> times;
  std::vector<std::vector<double>> positions;
  std::vector<std::vector<double>> velocities;
  std::vector<double> position = start;
  double time = 0.0;
  for (int i = 0; i < points; ++i) {
    const double step = random.uniform(0.1, 0.8);
    times.push_back(time += step);
    std::vector<double> velocity(static_cast<std::size_t>(joints), 0.0);
    for (std::size_t j = 0; j < position.size(); ++j) {
      position[j] += random.uniform(-1.0, 1.0) * step * step;
      if (i + 1 < points) velocity[j] = random.uniform(-0.3, 0.3);
    }
    positions.push_back(position);
    velocities.push_back(velocity);
  }
  return with_velocities ? make_goal(times, positions, velocities) : make_goal(times, positions);
}

// Whatever goal is accepted is played as it was given, on drives with any clock and phase; whatever is
// refused moves nothing.
TEST(RandomGoals, AcceptedMeansPlayedRefusedMeansStill) {
  int accepted_goals = 0;
  for (int seed = 1; seed <= trajectory::property_cases(40); ++seed) {
    trajectory::Random random(static_cast<std::uint64_t>(seed));
    const int joints = random.integer(1, 3);
    std::string changes = "{drives: {";
    for (int j = 1; j <= joints; ++j) {
      changes += "joint" + std::to_string(j) + ": {direction: " + (random.integer(0, 1) == 1 ? "1" : "-1") +
                 ", offset: " + std::to_string(random.uniform(-1.0, 1.0)) +
                 ", emulation: {clock_error_ppm: " + std::to_string(random.uniform(-200.0, 200.0)) +
                 ", tick_phase: " + std::to_string(random.uniform(0.0, 0.0009)) + "}}, ";
    }
    Scenario scenario(arm_of(joints, changes + "}}"));
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle))
        << "seed " << seed << ": " << scenario.snapshot().fault;
    for (int goal = 0; goal < 3; ++goal) {
      const auto before = scenario.positions();
      const auto accepted = scenario.submit(random_goal(random, joints, before));
      if (!accepted) {
        scenario.run(0.2);
        EXPECT_EQ(scenario.positions(), before) << "seed " << seed;
        continue;
      }
      ++accepted_goals;
      const auto result = scenario.result_of(accepted.value().id);
      ASSERT_EQ(result.outcome, GoalOutcome::Succeeded) << "seed " << seed << ": " << result.text;
      for (const auto& joint : scenario.driver().report().joints) {
        ASSERT_LE(joint.worst_deviation, 1.0) << "seed " << seed << ", " << joint.joint;
        ASSERT_LE(joint.final_deviation, 1.0) << "seed " << seed << ", " << joint.joint;
        ASSERT_EQ(joint.underruns, 0u) << "seed " << seed << ", " << joint.joint;
      }
    }
  }
  EXPECT_GT(accepted_goals, trajectory::property_cases(40)) << "too few goals are accepted to show anything";
}

}  // namespace
}  // namespace interpolated_motion::test
