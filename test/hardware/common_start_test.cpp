#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "hardware/sine_timing.h"

// Drives of different kinds, on a CAN bus that starts them at one SYNC and on serial lines that start them
// one after the other, go along one path together: as far as the drives themselves and true time tell.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr double kTogether = 1e-3;  ///< s
/// Of the arms of scenario.h: 2000 x 100 and 4000 x 50 counts per revolution of the joint.
constexpr double kCountsPerRadian = 200'000.0 / (2.0 * kPi);
constexpr std::size_t kJoints = 6;

struct Ride {
  double first_spread = 0.0;  ///< s, when the last drive has got to the first steep part
  double worst_spread = 0.0;  ///< s
  double worst_gain = 0.0;    ///< s, of a drive against true time
  std::uint64_t looks = 0;
};

/// Plays the sine goal for `seconds` and looks at the drives.
Ride ride(const YAML::Node& arm, double seconds) {
  Ride seen;
  Scenario scenario(arm);
  SineTiming timing(scenario, kJoints, kCountsPerRadian);
  EXPECT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(sine_goal(kJoints, seconds));
  if (!accepted) {
    ADD_FAILURE() << accepted.error().text;
    return seen;
  }
  EXPECT_TRUE(scenario.run_until([&] { return timing.spread().has_value(); }, 3.0));
  seen.first_spread = timing.spread().value_or(1.0);
  const auto result = scenario.result_of(accepted.value().id, seconds + 10.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_LE(joint.worst_deviation, 2.0) << joint.joint;
    EXPECT_LE(joint.final_deviation, 1.0) << joint.joint;
    EXPECT_EQ(joint.underruns, 0U) << joint.joint;
  }
  seen.worst_spread = timing.worst_spread();
  seen.looks = timing.looks();
  for (std::size_t joint = 0; joint < kJoints; ++joint)
    seen.worst_gain = std::max(seen.worst_gain, std::abs(timing.gained(joint)));
  return seen;
}

TEST(CommonStart, MixedArmStaysTogetherForTenMinutes) {
  const Ride seen = ride(six_axis_mixed("{drives: {joint1: {emulation: {clock_error_ppm: 100}}, "
                                        "joint2: {emulation: {clock_error_ppm: -100}}, "
                                        "joint3: {emulation: {tick_phase: 0.0006}}, "
                                        "joint4: {emulation: {clock_error_ppm: -100}}, "
                                        "joint5: {emulation: {clock_error_ppm: 100}}, "
                                        "joint6: {emulation: {tick_phase: 0.00007}}}}"),
                         600.0);
  EXPECT_LE(seen.first_spread, kTogether);
  EXPECT_LE(seen.worst_spread, kTogether);
  EXPECT_LE(seen.worst_gain, kTogether) << "left to their crystals, they would be 60 ms off";
  EXPECT_GT(seen.looks, 1'000'000U);
  RecordProperty("first_spread_us", std::to_string(1e6 * seen.first_spread));
  RecordProperty("worst_spread_us", std::to_string(1e6 * seen.worst_spread));
  RecordProperty("worst_gain_us", std::to_string(1e6 * seen.worst_gain));
  std::printf("spread at the start %.0f us, worst %.0f us, against true time %.0f us\n",
              1e6 * seen.first_spread, 1e6 * seen.worst_spread, 1e6 * seen.worst_gain);
}

/// Any crystals, phases of their ticks, and delays of their answers.
std::string random_drives(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  std::string drives;
  for (std::size_t joint = 1; joint <= kJoints; ++joint) {
    drives += fmt::format("joint{}: {{emulation: {{clock_error_ppm: {}, tick_phase: {}}}}}, ", joint,
                          number(-100.0, 100.0), number(0.0, 0.000119));
  }
  return "{drives: {" + drives + "}}";
}

class CommonStarts : public testing::TestWithParam<unsigned> {};

TEST_P(CommonStarts, OfAMixedArm) {
  const Ride seen = ride(six_axis_mixed(random_drives(GetParam())), 4.0);
  EXPECT_LE(seen.first_spread, kTogether);
  EXPECT_LE(seen.worst_spread, kTogether);
}

TEST_P(CommonStarts, OfAnArmOnTwoLines) {
  const Ride seen = ride(six_axis_silverlode(random_drives(GetParam())), 4.0);
  EXPECT_LE(seen.first_spread, kTogether);
  EXPECT_LE(seen.worst_spread, kTogether);
}

INSTANTIATE_TEST_SUITE_P(Seeds, CommonStarts, testing::Range(0U, 8U));

}  // namespace
}  // namespace interpolated_motion::test
