#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"

// A goal that a fault ends is over when every drive that can be seen stands, whatever its kind and however
// many there are.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

/// rad, three counts of an EPOS: a joint that stands.
constexpr double kStanding = 1e-4;
/// s after the start, while records of three seconds are still to be sent (`commit_horizon` is two).
constexpr double kStillFed = 0.7;

class EndAtRest : public FaultInMotion {
 protected:
  /// Each joint over 2.5 rad, `for_seconds` after the start, at about 1.5 rad/s in the middle of three
  /// seconds.
  void set_out(const YAML::Node& parameters, double for_seconds = 1.2) {
    scenario = std::make_unique<Scenario>(parameters);
    ASSERT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
    joints_ = parameters["joints"].size();
    const auto accepted = scenario->submit(make_goal({3.0}, {std::vector<double>(joints_, 2.5)}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    goal = accepted.value().id;
    ASSERT_TRUE(scenario->run_until_state(GroupState::Moving));
    scenario->run(for_seconds);
    ASSERT_EQ(scenario->state(), GroupState::Moving);
  }

  /// Where the drives themselves stand, whatever their buses tell.
  std::vector<double> standing() const {
    std::vector<double> positions;
    for (std::size_t i = 0; i < joints_; ++i) positions.push_back(*scenario->driver().emulated_position(i));
    return positions;
  }

  /// The goal ends, and from then on no drive moves.
  motion::GoalResult expect_end_at_rest(double within) {
    auto result = scenario->result_of(goal, within);
    EXPECT_EQ(result.outcome, GoalOutcome::Aborted) << result.text;
    EXPECT_EQ(scenario->state(), GroupState::Fault);
    const auto ended = standing();
    scenario->run(1.0);
    const auto later = standing();
    for (std::size_t i = 0; i < joints_; ++i)
      EXPECT_NEAR(later[i], ended[i], kStanding) << "joint" << i + 1 << " was told at rest but moved on";
    return result;
  }

  std::size_t joints_ = 0;
};

TEST_F(EndAtRest, LostRecordOfTheOnlyJoint) {
  set_out(arm_of(1), kStillFed);
  inject("can0", "drop_id 0x201 1");
  const auto result = expect_end_at_rest(5.0);
  EXPECT_TRUE(contains(result.text, "record was lost")) << result.text;
  EXPECT_FALSE(contains(result.text, "other joints")) << result.text;
}

TEST_F(EndAtRest, LostRecordOfOneOfSeveralJoints) {
  set_out(six_axis(), kStillFed);
  inject("can0", "drop_id 0x203 1");
  const auto result = expect_end_at_rest(5.0);
  EXPECT_TRUE(contains(result.text, "The other joints were stopped.")) << result.text;
}

// The drive brakes by its fault reaction, and says so: that is not yet rest.
TEST_F(EndAtRest, FaultOfTheOnlyEpos) {
  set_out(arm_of(1));
  inject("joint1", "emcy 0x2310");
  const auto result = expect_end_at_rest(1.0);
  EXPECT_TRUE(contains(result.text, "0x2310")) << result.text;
  EXPECT_FALSE(contains(result.text, "other joints")) << result.text;
}

TEST_F(EndAtRest, FaultOfTheOnlyCyclicDrive) {
  set_out(arm_of(1, "{drives: {joint1: {type: cyclic}}}"));
  inject("joint1", "emcy 0x2310");
  const auto result = expect_end_at_rest(1.0);
  EXPECT_TRUE(contains(result.text, "0x2310")) << result.text;
}

TEST_F(EndAtRest, LostTargetPositionsOfTheOnlyCyclicDrive) {
  set_out(arm_of(1, "{drives: {joint1: {type: cyclic}}}"));
  inject("can0", "drop_id 0x201 6");
  const auto result = expect_end_at_rest(1.0);
  EXPECT_TRUE(contains(result.text, "0x8700")) << result.text;
}

TEST_F(EndAtRest, FaultOfOneOfSeveralCyclicDrives) {
  set_out(six_axis_cyclic());
  inject("joint2", "emcy 0x2310");
  expect_end_at_rest(1.0);
}

// Nobody sees or tells this drive: it plays on as far as its FIFO goes (commit_horizon, 2 s), and brakes
// then.
TEST_F(EndAtRest, EposThatCannotBeHeard) {
  set_out(arm_of(2));
  inject("joint1", "silence 1");
  const auto result = expect_end_at_rest(3.0);
  EXPECT_TRUE(contains(result.text, "Joint joint1")) << result.text;
}

TEST_F(EndAtRest, CyclicDriveThatCannotBeHeard) {
  set_out(six_axis_cyclic());
  inject("joint1", "silence 1");
  expect_end_at_rest(2.0);
}

TEST_F(EndAtRest, SilverlodeFaultFoundByTheHost) {
  set_out(six_axis_silverlode());
  inject("joint2", "nak 25 5 1000000");
  expect_end_at_rest(4.0);
}

TEST_F(EndAtRest, FaultInAGroupOfAllKinds) {
  set_out(six_axis_of_all_kinds(), kStillFed);
  inject("can0", "drop_id 0x203 1");
  expect_end_at_rest(5.0);
}

// A halt is under way when the fault comes: it ends the same way.
TEST_F(EndAtRest, FaultWhileTheGroupBrakes) {
  set_out(arm_of(1));
  scenario->driver().halt(scenario->now());
  scenario->run(0.02);
  inject("joint1", "emcy 0x2310");
  expect_end_at_rest(1.0);
}

TEST_F(EndAtRest, FaultInAStream) {
  scenario = std::make_unique<Scenario>(arm_of(1));
  ASSERT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
  joints_ = 1;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.02 * i;
    motion::Setpoint setpoint;
    setpoint.time = scenario->now();
    setpoint.joint_names = {"joint1"};
    setpoint.positions = {1.0 - std::cos(t)};
    setpoint.velocities = {std::sin(t)};
    const auto refusal = scenario->driver().setpoint(setpoint, scenario->now());
    ASSERT_FALSE(refusal) << refusal->text;
    scenario->run(0.02);
  }
  ASSERT_EQ(scenario->state(), GroupState::Streaming);
  inject("joint1", "emcy 0x2310");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 1.0));
  const auto ended = standing();
  scenario->run(1.0);
  EXPECT_NEAR(standing()[0], ended[0], kStanding);
}

}  // namespace
}  // namespace interpolated_motion::test
