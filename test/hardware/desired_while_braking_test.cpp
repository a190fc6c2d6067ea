#include <cmath>
#include <ostream>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

// What is published as desired while a motion ends before its time: the braking, and no jump to where an
// earlier goal began (field trial S20).
namespace interpolated_motion::test {
namespace {

using motion::GroupState;

struct Arm {
  const char* name;
  YAML::Node (*parameters)(const std::string& changes);
};
std::ostream& operator<<(std::ostream& out, const Arm& arm) { return out << arm.name; }

class DesiredWhileBraking : public testing::TestWithParam<Arm> {
 protected:
  /// Two thirds of a second into the first goal all joints move at up to 2 rad/s.
  void SetUp() override {
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
    const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
    ASSERT_TRUE(accepted) << accepted.error().text;
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
    scenario.run(1.5);
  }

  /// Each millisecond until the group rests, and some time after that.
  void expect_desired_near_actual() {
    double rested = 0.0;
    for (int ms = 0; ms < 10000 && rested < 0.3; ++ms) {
      scenario.run(0.001);
      const auto snapshot = scenario.snapshot();
      for (const auto& joint : snapshot.joints) {
        // A lag of 2 ms at 3.5 rad/s, and what the position changes by between two reports of a drive.
        ASSERT_NEAR(joint.desired.position, joint.actual.position, 0.02)
            << joint.joint << ", " << motion::to_string(snapshot.state) << ", " << ms << " ms";
      }
      const bool moves = snapshot.state != GroupState::Idle && snapshot.state != GroupState::Fault;
      rested = moves ? 0.0 : rested + 0.001;
    }
  }

  Scenario scenario{GetParam().parameters("")};
};

TEST_P(DesiredWhileBraking, FollowsTheArmInAHalt) {
  scenario.driver().halt(scenario.now());
  expect_desired_near_actual();
}

TEST_P(DesiredWhileBraking, FollowsTheArmWhenAGoalIsReplaced) {
  std::vector<double> target = scenario.positions();
  for (double& position : target) position -= 0.3;
  ASSERT_TRUE(scenario.submit(make_goal({2.0}, {target})));
  expect_desired_near_actual();
}

TEST_P(DesiredWhileBraking, FollowsTheArmInAFault) {
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("joint2", "silence 1", &reason, scenario.now()) ||
              scenario.driver().inject("joint2", "fault moving_error", &reason, scenario.now()))
      << reason;
  expect_desired_near_actual();
}

INSTANTIATE_TEST_SUITE_P(Kinds, DesiredWhileBraking,
                         testing::Values(Arm{"epos", six_axis}, Arm{"silverlode", six_axis_silverlode},
                                         Arm{"cyclic", six_axis_cyclic}, Arm{"mixed", six_axis_mixed}),
                         [](const testing::TestParamInfo<Arm>& arm) { return arm.param.name; });

}  // namespace
}  // namespace interpolated_motion::test
