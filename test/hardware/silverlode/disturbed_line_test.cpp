#include <string>

#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"

// What disturbs the bring-up of a serial line is recognised for what it is, and tried again while nothing
// moves.
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(DisturbedLine, RepliesThatAreLateAreNamedWithTheParameter) {
  for (const char* turnaround : {"0.03", "0.041", "0.06", "0.1"}) {
    Scenario scenario(six_axis_silverlode(std::string("{drives: {joint2: {emulation: {turnaround: ") +
                                          turnaround + "}}}}"));
    ASSERT_TRUE(scenario.run_until_state(GroupState::Fault, 30.0)) << turnaround;
    const std::string fault = scenario.snapshot().fault;
    EXPECT_TRUE(contains(fault, "joint2")) << fault;
    EXPECT_TRUE(contains(fault, "raise buses/line0/reply_timeout")) << turnaround << ": " << fault;
    EXPECT_FALSE(contains(fault, "joint1 (")) << "the others are well: " << fault;
  }
}

TEST(DisturbedLine, RepliesThatAreLateAreFineWhereThatIsAllowed) {
  Scenario scenario(six_axis_silverlode(
      "{buses: {line0: {reply_timeout: 0.06}}, drives: {joint2: {emulation: {turnaround: 0.041}}}}"));
  EXPECT_TRUE(scenario.run_until_state(GroupState::Idle, 30.0)) << scenario.snapshot().fault;
}

// Two seconds of noise on each reply, within the time for bring-up.
TEST(DisturbedLine, NoiseDuringBringUpIsOutlasted) {
  Scenario scenario(six_axis_silverlode());
  std::string reason;
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(scenario.driver().inject("line0", "garble_replies 3", &reason, scenario.now())) << reason;
    scenario.run(0.01);
  }
  EXPECT_TRUE(scenario.run_until_state(GroupState::Idle, 10.0)) << scenario.snapshot().fault;
}

TEST(DisturbedLine, NoiseThatDoesNotEndIsCalledNoise) {
  Scenario scenario(six_axis_silverlode());
  std::string reason;
  for (int i = 0; i < 1500 && scenario.state() != GroupState::Fault; ++i) {
    ASSERT_TRUE(scenario.driver().inject("line0", "garble_replies 3", &reason, scenario.now())) << reason;
    scenario.run(0.01);
  }
  const std::string fault = scenario.snapshot().fault;
  EXPECT_TRUE(contains(fault, "garbled")) << fault;
  EXPECT_TRUE(contains(fault, "noise")) << fault;
  EXPECT_FALSE(contains(fault, "none of other addresses")) << fault;
}

}  // namespace
}  // namespace interpolated_motion::test
