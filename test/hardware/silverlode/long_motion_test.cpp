#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/playback.h"
#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr double kCountsPerRadian = 4000.0 * 50.0 / (2.0 * kPi);

/// Hours of motion in virtual time; IMD_LONG_HOURS=24 for a day.
double hours() {
  const char* text = std::getenv("IMD_LONG_HOURS");
  return text == nullptr ? 1.0 / 3.0 : std::atof(text);
}

YAML::Node arm_of_two_silverlode() {
  YAML::Node arm = six_axis_silverlode(
      "{drives: {joint1: {emulation: {clock_error_ppm: 100}}, "
      "joint2: {emulation: {clock_error_ppm: -100, tick_phase: 0.00005}}}}");
  YAML::Node joints;
  YAML::Node drives;
  for (const char* joint : {"joint1", "joint2"}) {
    joints.push_back(joint);
    drives[joint] = arm["drives"][joint];
  }
  arm["joints"] = joints;
  arm["drives"] = drives;
  arm["buses"].remove("line1");
  return arm;
}

/// A goal of `points` points, each 0.2 s after the one before, from `position` on; it ends at rest there
/// where its last point is. Every goal has other numbers, so no rounding repeats itself.
trajectory::Goal wandering_goal(int number, int points, std::vector<double>& position) {
  std::vector<double> times;
  std::vector<std::vector<double>> positions;
  const std::vector<double> start = position;
  for (int i = 1; i <= points; ++i) {
    const double along = 0.2 * i;
    const double fade = std::sin(kPi * i / (2.0 * points));  // from the start to the goal's own curve
    for (std::size_t joint = 0; joint < position.size(); ++joint) {
      const double pace = 1.1 + 0.13 * static_cast<double>(joint) + 0.0137 * (number % 17);
      const double curve = 0.5 * std::sin(pace * along) + 0.1 * std::sin(0.31 * number + 0.7 * along);
      position[joint] = start[joint] + fade * fade * (curve - start[joint]);
    }
    times.push_back(along);
    positions.push_back(position);
  }
  return make_goal(times, positions);
}

// Goal after goal, each from where the last one ended, on drives that count on: whatever were lost or gained
// in a segment, a goal or a start would add up.
TEST(SilverlodeLongMotion, NothingDriftsHoweverLong) {
  constexpr int kPoints = 3000;  // ten minutes
  const int goals = std::max(1, static_cast<int>(std::lround(6.0 * hours())));
  Scenario scenario(arm_of_two_silverlode());
  std::vector<double> demand(2, 0.0);
  scenario.driver().set_sample_observer(
      [&demand](std::size_t joint, const hardware::DemandSample& sample) { demand[joint] = sample.demand; });
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  std::vector<double> target(2, 0.0);
  double worst = 0.0;
  std::uint64_t segments = 0;
  const auto began = std::chrono::steady_clock::now();
  for (int number = 0; number < goals; ++number) {
    const auto accepted = scenario.submit(wandering_goal(number, kPoints, target));
    ASSERT_TRUE(accepted) << number << ": " << accepted.error().text;
    const auto result = scenario.result_of(accepted.value().id, 700.0);
    ASSERT_EQ(result.outcome, GoalOutcome::Succeeded) << number << ": " << result.text;
    const auto report = scenario.driver().report();
    for (std::size_t joint = 0; joint < 2; ++joint) {
      ASSERT_LE(report.joints[joint].worst_deviation, 2.0) << "goal " << number;
      ASSERT_EQ(report.joints[joint].underruns, 0U) << "goal " << number;
      ASSERT_NEAR(demand[joint], target[joint] * kCountsPerRadian, 1.0) << "goal " << number;
      worst = std::max(worst, report.joints[joint].worst_deviation);
      segments += report.joints[joint].records_sent;
    }
  }
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  std::printf(
      "%d goals of ten minutes, %llu segments: worst deviation %.3f counts; %.1f s, %.0f x real time\n",
      goals, static_cast<unsigned long long>(segments), worst, took, 600.0 * goals / took);
}

}  // namespace
}  // namespace interpolated_motion::test
