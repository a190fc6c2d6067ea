#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

// The status words of a SilverLode drive are latched: what is cleared has been read and is told.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

const std::vector<double> kFirst{0.6, 0.6, 0.6, 0.6, 0.6, 0.6};
const std::vector<double> kSecond{0.1, 0.1, 0.1, 0.1, 0.1, 0.1};

struct ClearedStatus : ::testing::Test {
  void start() {
    scenario = std::make_unique<Scenario>(six_axis_silverlode());
    ASSERT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
  }

  void inject(const std::string& command) {
    std::string reason;
    ASSERT_TRUE(scenario->driver().inject("joint2", command, &reason, scenario->now())) << reason;
  }

  bool is_logged(const std::string& part) {
    scenario->run(0.0);
    return std::any_of(scenario->log().begin(), scenario->log().end(), [&part](const std::string& line) {
      return line.find("joint2") != std::string::npos && line.find(part) != std::string::npos;
    });
  }

  void expect_fault(const std::string& part, double within) {
    EXPECT_TRUE(scenario->run_until_state(GroupState::Fault, within))
        << "state " << to_string(scenario->state());
    const std::string fault = scenario->snapshot().fault;
    EXPECT_NE(fault.find("joint2"), std::string::npos) << fault;
    EXPECT_NE(fault.find(part), std::string::npos) << fault;
  }

  std::unique_ptr<Scenario> scenario;
};

// A goal is replaced in motion, and a drive has its fault while the group stops, loads or starts: the fault
// is found by its cause, and the others do not move on for longer than it takes to look.
TEST_F(ClearedStatus, AFaultAroundAReplacementKeepsItsCause) {
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    start();
    ASSERT_TRUE(scenario->submit(make_goal({3.0}, {kFirst})));
    ASSERT_TRUE(scenario->run_until_state(GroupState::Moving));
    scenario->run(1.0);
    const auto second = scenario->submit(make_goal({3.0}, {kSecond}));
    ASSERT_TRUE(second) << second.error().text;
    scenario->run(0.05 * i);
    inject("fault moving_error");
    expect_fault("moving error", 3.0);
    EXPECT_EQ(scenario->result_of(second.value().id).outcome, GoalOutcome::Aborted);
  }
}

TEST_F(ClearedStatus, AFaultBetweenTwoGoalsIsNotErasedByTheSecond) {
  for (const char* fault : {"fault moving_error", "fault over_voltage", "fault low_voltage"}) {
    SCOPED_TRACE(fault);
    start();
    inject(fault);
    const auto goal = scenario->submit(make_goal({3.0}, {kFirst}));
    ASSERT_TRUE(goal) << goal.error().text;
    expect_fault(std::string(fault) == "fault moving_error" ? "moving error" : "voltage", 3.0);
    for (const double position : scenario->positions()) EXPECT_NEAR(position, 0.0, 1e-4);
  }
}

TEST_F(ClearedStatus, AVoltageErrorInMotionIsToldAsTheCause) {
  start();
  ASSERT_TRUE(scenario->submit(make_goal({3.0}, {kFirst})));
  ASSERT_TRUE(scenario->run_until_state(GroupState::Moving));
  scenario->run(1.0);
  inject("fault over_voltage");
  inject("fault moving_error");
  expect_fault("low or over voltage", 3.0);
}

TEST_F(ClearedStatus, AResetTellsWhatItClears) {
  start();
  inject("fault moving_error");
  expect_fault("moving error", 2.0);
  EXPECT_FALSE(is_logged("found with a fault"));
  ASSERT_TRUE(scenario->result_of_request(scenario->driver().reset_faults(scenario->now())).success);
  EXPECT_TRUE(is_logged("found with a fault, which is cleared now: the drive reports: "));
  EXPECT_TRUE(is_logged("moving error"));
  ASSERT_TRUE(scenario->result_of_request(scenario->driver().enable(true, scenario->now())).success);
}

// The drive is told off, and its fault comes while it is off: enabling does not erase it either.
TEST_F(ClearedStatus, EnablingErasesNothing) {
  start();
  ASSERT_TRUE(scenario->result_of_request(scenario->driver().enable(false, scenario->now())).success);
  const auto on = scenario->driver().enable(true, scenario->now());
  inject("fault holding_error");
  EXPECT_FALSE(scenario->result_of_request(on).success);
  expect_fault("holding error", 1.0);
}

}  // namespace
}  // namespace interpolated_motion::test
