#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"

// A second master on the bus: a driver started twice, a vendor's tool, cansend.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

struct Arm {
  const char* name;
  YAML::Node (*make)(const std::string& changes);
};

class OtherMaster : public FaultInMotion, public ::testing::WithParamInterface<Arm> {
 protected:
  void send(const std::string& frame) { inject("can0", "send " + frame); }

  /// Runs while another master sends SYNC.
  void run_beside_a_master(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / 0.01); ++i) {
      send("080#");
      scenario->run(0.01);
    }
  }

  /// Frames of this host that have been on the bus from now on.
  void count_own_frames() {
    hardware::WireObserver observer;
    observer.frame = [this](const std::string&, const canopen::ReceivedFrame& frame) {
      if (frame.own) ++own_frames;
    };
    scenario->driver().set_wire_observer(observer);
  }

  int own_frames = 0;
};

TEST_P(OtherMaster, InMotionEndsTheMotionAndIsNamed) {
  for (const std::string frame :
       {"080#", "201#0000000000000000", "602#4041600000000000", "000#8009", "77F#05"}) {
    move(GetParam().make(""));
    send(frame);
    const auto result = scenario->result_of(goal);
    EXPECT_EQ(result.outcome, GoalOutcome::Aborted) << frame;
    EXPECT_TRUE(contains(result.text, "another master is on can0")) << result.text;
    EXPECT_TRUE(contains(result.text, frame)) << result.text;
    EXPECT_TRUE(contains(result.text, "other_masters")) << result.text;
    expect_recovery();
  }
}

TEST_P(OtherMaster, AtRestIsAFault) {
  scenario = std::make_unique<Scenario>(GetParam().make(""));
  ASSERT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
  send("080#");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 0.03));
  EXPECT_TRUE(contains(scenario->snapshot().fault, "SYNC, 080#")) << scenario->snapshot().fault;
  expect_recovery();
}

TEST_P(OtherMaster, IsHeardBeforeAnythingIsSent) {
  scenario = std::make_unique<Scenario>(GetParam().make(""));
  count_own_frames();
  run_beside_a_master(1.0);
  EXPECT_EQ(scenario->state(), GroupState::Fault);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "another master is on can0"))
      << scenario->snapshot().fault;
  // Neither what the user asks for nor the end of the node goes to drives that another has.
  scenario->driver().enable(true, scenario->now());
  scenario->driver().halt(scenario->now());
  scenario->driver().clear_buffers(scenario->now());
  run_beside_a_master(0.5);
  const auto reset = scenario->driver().reset_faults(scenario->now());
  run_beside_a_master(1.0);
  EXPECT_FALSE(scenario->result_of_request(reset).success);
  const auto off = scenario->driver().shut_down(scenario->now());
  run_beside_a_master(2.0);
  scenario->result_of_request(off);
  EXPECT_EQ(own_frames, 0);
}

TEST_P(OtherMaster, ThatHasGoneIsNoFaultAnyMore) {
  scenario = std::make_unique<Scenario>(GetParam().make(""));
  run_beside_a_master(1.0);
  ASSERT_EQ(scenario->state(), GroupState::Fault);
  expect_recovery();
}

// The last words of a driver that has just ended.
TEST_P(OtherMaster, ThatFallsSilentAtTheStartIsWaitedFor) {
  scenario = std::make_unique<Scenario>(GetParam().make(""));
  run_beside_a_master(0.1);
  EXPECT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
}

// TIME (0x100) is not among them, see ClockDiscipline.
TEST_P(OtherMaster, OfOtherNodesIsNone) {
  move(GetParam().make(""));
  for (const char* frame : {"189#3702", "709#05", "609#4041600000000000", "209#00", "089#0000000000000000",
                            "7E5#0400000000000000", "781#00", "00012345#01"})
    send(frame);
  const auto result = scenario->result_of(goal);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
}

TEST_P(OtherMaster, CanBeAllowed) {
  move(GetParam().make("{buses: {can0: {other_masters: allow}}}"));
  for (const char* frame : {"602#4041600000000000", "000#0109", "77F#05"}) send(frame);
  EXPECT_EQ(scenario->result_of(goal).outcome, GoalOutcome::Succeeded);
}

const Arm kArms[] = {{"Epos", six_axis}, {"Cyclic", six_axis_cyclic}};

INSTANTIATE_TEST_SUITE_P(CanDrives, OtherMaster, ::testing::ValuesIn(kArms),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
