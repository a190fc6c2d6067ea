#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

// A joint that stands outside its limits of position, by a few counts (it has been left at the limit, and an
// encoder tells whole counts) or by more (moved by hand): it can be moved in, and not out.
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

struct Outside {
  const char* name;
  YAML::Node (*make)(const std::string& changes);
  double position;  ///< rad, of joint1, whose limits are 0 and 2 rad
};

const Outside kOutside[] = {
    {"EposByThreeCounts", six_axis, -1e-4},
    {"EposFar", six_axis, -0.2},
    {"EposAbove", six_axis, 2.2},
    {"CyclicByThreeCounts", six_axis_cyclic, -1e-4},
    {"CyclicFar", six_axis_cyclic, -0.2},
    {"CyclicAbove", six_axis_cyclic, 2.2},
    {"SilverlodeByThreeCounts", six_axis_silverlode, -1e-4},
    {"SilverlodeFar", six_axis_silverlode, -0.2},
    {"SilverlodeAbove", six_axis_silverlode, 2.2},
};

class JointOutsideItsLimits : public ::testing::TestWithParam<Outside> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  }

  static std::string changes() {
    return "{drives: {joint1: {limits: {min_position: 0, max_position: 2}, emulation: {initial_position: " +
           std::to_string(GetParam().position) + "}}}}";
  }

  /// joint1 goes to `first`, the others stay.
  static trajectory::Goal to(double first) { return make_goal({2.0}, {{first, 0, 0, 0, 0, 0}}); }
  static double outward() { return GetParam().position + (GetParam().position < 1.0 ? -0.01 : 0.01); }

  void expect_done(const trajectory::Goal& goal, double first) {
    const auto taken = scenario.submit(goal);
    ASSERT_TRUE(taken) << taken.error().text;
    const auto result = scenario.result_of(taken.value().id);
    EXPECT_EQ(result.outcome, motion::GoalOutcome::Succeeded) << result.text;
    EXPECT_NEAR(scenario.positions()[0], first, 2e-4);
  }

  void expect_refused(double first) {
    const auto refused = scenario.submit(to(first));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().text.find("joint1: the position"), std::string::npos) << refused.error().text;
  }

  Scenario scenario{GetParam().make(changes())};
};

TEST_P(JointOutsideItsLimits, MayMoveInAndThenNotOutAgain) {
  expect_done(to(1.0), 1.0);
  expect_refused(GetParam().position - (GetParam().position < 1.0 ? 1e-4 : 0.0));
  EXPECT_EQ(scenario.state(), GroupState::Idle);
}

TEST_P(JointOutsideItsLimits, MayStayWhileOthersMove) {
  const double stays = GetParam().position;
  expect_done(make_goal({0.0, 2.0}, {{stays, 0, 0, 0, 0, 0}, {stays, 0.4, 0, 0, 0, 0}}), stays);
  EXPECT_NEAR(scenario.positions()[1], 0.4, 2e-4);
}

TEST_P(JointOutsideItsLimits, MayNotMoveOut) {
  const auto refused = scenario.submit(to(outward()));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("from there only the way in is allowed"), std::string::npos)
      << refused.error().text;
}

TEST_P(JointOutsideItsLimits, IsStoppedOnItsWayIn) {
  const auto taken = scenario.submit(to(1.0));
  ASSERT_TRUE(taken) << taken.error().text;
  scenario.run(0.9);
  const auto halt = scenario.driver().halt(scenario.now());
  EXPECT_TRUE(scenario.result_of_request(halt).success);
  EXPECT_EQ(scenario.state(), GroupState::Idle) << scenario.snapshot().fault;
  expect_done(to(1.0), 1.0);
}

TEST_P(JointOutsideItsLimits, FollowsSetpointsIn) {
  motion::Setpoint setpoint;
  for (int i = 1; i <= 6; ++i) setpoint.joint_names.push_back("joint" + std::to_string(i));
  setpoint.source = "test";
  const double from = GetParam().position;
  for (int i = 0; i <= 150; ++i) {
    const double part = std::clamp((i - 50) / 100.0, 0.0, 1.0);
    setpoint.positions = {from + (1.0 - from) * part * part * (3.0 - 2.0 * part), 0, 0, 0, 0, 0};
    setpoint.time = scenario.now();
    const auto refusal = scenario.driver().setpoint(setpoint, scenario.now());
    ASSERT_FALSE(refusal) << i << ": " << refusal->text;
    scenario.run(0.02);
  }
  EXPECT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  EXPECT_NEAR(scenario.positions()[0], 1.0, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, JointOutsideItsLimits, ::testing::ValuesIn(kOutside),
                         [](const ::testing::TestParamInfo<Outside>& arm) { return arm.param.name; });

}  // namespace
}  // namespace interpolated_motion::test
