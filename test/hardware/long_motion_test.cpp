#include <cmath>

#include <gtest/gtest.h>

#include "hardware/playback.h"
#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

// Left alone, crystals of +-100 ppm are 120 ms apart after ten minutes. Every drive is fed by its own clock,
// so none runs dry or over; and the estimate of what each one plays stays within one report (a SYNC period)
// and a sample.
TEST(LongMotion, TenMinutesWithUnequalClocks) {
  Scenario scenario(arm_of(3,
                           "{buses: {can0: {clock_discipline: false}}, drives: {joint1: {emulation: "
                           "{clock_error_ppm: 100}}, joint2: {emulation: {clock_error_ppm: -100}}, joint3: "
                           "{emulation: {clock_error_ppm: 0}}}}"));
  Playback playback(scenario, 3);
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  const auto accepted = scenario.submit(sine_goal(3, 600.0));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  double worst = 0.0;
  scenario.run_until(
      [&] {
        const auto snapshot = scenario.snapshot();
        if (snapshot.state != GroupState::Moving) return true;
        for (const auto& joint : snapshot.joints) {
          worst = std::max(worst, std::abs(joint.desired.position - joint.actual.position));
        }
        return false;
      },
      620.0);
  const auto clocks = scenario.snapshot();
  const auto result = scenario.result_of(accepted.value().id, 20.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  EXPECT_NEAR(1e3 * playback.gained(0), 60.0, 0.1);
  EXPECT_NEAR(1e3 * playback.gained(1), -60.0, 0.1);
  EXPECT_NEAR(1e3 * playback.gained(2), 0.0, 0.001);
  EXPECT_LT(worst, kSineSpeed * (0.010 + 0.001 + 0.002)) << "SYNC period, a sample, and the lag of the axis";
  EXPECT_NEAR(clocks.joints[0].clock_error_ppm, 100.0, 25.0);
  EXPECT_NEAR(clocks.joints[1].clock_error_ppm, -100.0, 25.0);
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_LE(joint.worst_deviation, 1.0) << joint.joint;
    EXPECT_EQ(joint.underruns, 0u) << joint.joint;
    EXPECT_EQ(joint.samples, 600001u) << joint.joint << ": sample 0 and one per ms";
  }
}

TEST(LongMotion, GoalAfterGoalNothingAddsUp) {
  Scenario scenario(arm_of(2));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  for (int i = 0; i < 50; ++i) {
    const double target = i % 2 == 0 ? 0.1234 : -0.0567;
    const auto accepted = scenario.submit(make_goal({0.3}, {{target, -target}}));
    ASSERT_TRUE(accepted) << i << ": " << accepted.error().text;
    ASSERT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded) << i;
    ASSERT_NEAR(scenario.positions()[0], target, 1.0 / 31830.0) << i;
  }
}

}  // namespace
}  // namespace interpolated_motion::test
