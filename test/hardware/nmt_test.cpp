#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"

// Another node tells a CANopen drive to leave Operational (NMT), resets it, or reaches into its objects, in
// motion and at rest. Other masters are allowed here, so that it is the drive's state that is noticed and not
// who is on the bus. For EPOS and cyclic drives.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr const char* kAllow = "{buses: {can0: {other_masters: allow}}}";
/// A drive whose PDOs can be changed while they are in use.
constexpr const char* kChangeable =
    "{buses: {can0: {other_masters: allow}}, drives: {joint2: {emulation: {pdo_setup_only_pre_operational: "
    "false}}}}";
constexpr std::size_t kJoint2 = 1;
/// Of a joint that stands: 3 counts at 200000 counts a turn.
constexpr double kStill = 1e-4;

struct Arm {
  const char* name;
  YAML::Node (*make)(const std::string& changes);
};

const Arm kArms[] = {{"Epos", six_axis}, {"Cyclic", six_axis_cyclic}};

struct Case {
  Arm arm;
  const char* frame;
  const char* text;
};

class DriveChanged : public FaultInMotion {
 protected:
  void stand(const YAML::Node& parameters) {
    scenario = std::make_unique<Scenario>(parameters);
    ASSERT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
  }

  void send(const std::string& frame) { inject("can0", "send " + frame); }

  double truth(std::size_t joint) { return *scenario->driver().emulated_position(joint); }

  /// All joints stand when the goal is said to have ended, wherever the drives say they are.
  void expect_rest_at_the_end(const std::string& text) {
    const auto result = scenario->result_of(goal);
    EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
    EXPECT_TRUE(contains(result.text, text)) << result.text;
    std::vector<double> at_end;
    for (std::size_t i = 0; i < 6; ++i) at_end.push_back(truth(i));
    scenario->run(3.0);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(truth(i), at_end[i], kStill) << "joint" << i + 1;
  }
};

class NmtOfAnother : public DriveChanged, public ::testing::WithParamInterface<Case> {};

TEST_P(NmtOfAnother, InMotionStopsTheGroupAndTheDriveByItsSecondWay) {
  move(GetParam().arm.make(kAllow));
  const double before = truth(kJoint2);
  const HostTime sent = scenario->now();
  send(GetParam().frame);
  ASSERT_TRUE(scenario->run_until([&] { return scenario->state() == GroupState::Stopping; }, 0.03));
  expect_rest_at_the_end(GetParam().text);
  // 3.5 rad/s at most, noticed in 30 ms; a drive that boots first answers late.
  EXPECT_LT(std::abs(truth(kJoint2) - before), 0.5);
  EXPECT_GT(scenario->now(), sent);
  EXPECT_FALSE(contains(scenario->snapshot().fault, "lost its power")) << scenario->snapshot().fault;
  expect_recovery();
}

TEST_P(NmtOfAnother, AtRestIsAFaultAtOnceAndIsConfiguredAnew) {
  stand(GetParam().arm.make(kAllow));
  const double before = truth(kJoint2);
  send(GetParam().frame);
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 0.03));
  EXPECT_TRUE(contains(scenario->snapshot().fault, GetParam().text)) << scenario->snapshot().fault;
  EXPECT_TRUE(contains(scenario->snapshot().fault, "joint2 (can0 node 2)")) << scenario->snapshot().fault;
  scenario->run(1.0);
  EXPECT_NEAR(truth(kJoint2), before, kStill);
  expect_recovery();
}

const Case kCases[] = {
    {kArms[0], "000#8002", "put in pre-operational by another node (NMT"},
    {kArms[0], "000#0202", "put in stopped by another node (NMT"},
    {kArms[0], "000#8202", "reset by another node (NMT"},
    {kArms[0], "000#8102", "reset by another node (NMT"},
    {kArms[0], "000#8000", "put in pre-operational by another node (NMT"},
    {kArms[1], "000#8002", "put in pre-operational by another node (NMT"},
    {kArms[1], "000#0202", "put in stopped by another node (NMT"},
    {kArms[1], "000#8202", "reset by another node (NMT"},
    {kArms[1], "000#8102", "reset by another node (NMT"},
    {kArms[1], "000#8000", "put in pre-operational by another node (NMT"},
};

INSTANTIATE_TEST_SUITE_P(CanDrives, NmtOfAnother, ::testing::ValuesIn(kCases), [](const auto& one) {
  return std::string(one.param.arm.name) + std::string(one.param.frame).substr(4);
});

class CanArm : public DriveChanged, public ::testing::WithParamInterface<Arm> {};

// The command itself may have been missed.
TEST_P(CanArm, HeartbeatThatSaysPreOperationalIsAFault) {
  stand(GetParam().make(kAllow));
  send("702#7F");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 0.03));
  EXPECT_TRUE(contains(scenario->snapshot().fault, "heartbeat says")) << scenario->snapshot().fault;
  expect_recovery();
}

TEST_P(CanArm, HeartbeatThatSaysStoppedInMotionStopsTheGroup) {
  move(GetParam().make(kAllow));
  send("702#04");
  expect_rest_at_the_end("put in stopped by another node (NMT), or went there by itself");
  expect_recovery();
}

// Told again and again, nothing is enabled by what the drive said long ago.
TEST_P(CanArm, NothingSucceedsOnWhatADriveHasSaidLongAgo) {
  stand(GetParam().make(kAllow));
  for (int i = 0; i < 3; ++i) {
    send("000#8002");
    scenario->run(0.05);
    const auto enabled = scenario->result_of_request(scenario->driver().enable(true, scenario->now()));
    EXPECT_FALSE(enabled.success);
    EXPECT_FALSE(scenario->submit(make_goal({1.0}, {{0.1, 0.1, 0.1, 0.1, 0.1, 0.1}})));
    const auto reset = scenario->result_of_request(scenario->driver().reset_faults(scenario->now()));
    EXPECT_TRUE(reset.success) << reset.message;
    EXPECT_FALSE(scenario->driver().emulated_power(kJoint2).value());
    EXPECT_TRUE(scenario->result_of_request(scenario->driver().enable(true, scenario->now())).success);
    EXPECT_TRUE(scenario->driver().emulated_power(kJoint2).value());
  }
}

TEST_P(CanArm, DisabledDriveThatIsPutInPreOperationalIsAFault) {
  stand(GetParam().make(kAllow));
  ASSERT_TRUE(scenario->result_of_request(scenario->driver().enable(false, scenario->now())).success);
  send("000#8002");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 0.03));
  expect_recovery();
}

// While a motion is stopped it can happen as well.
TEST_P(CanArm, StopIsCarriedToItsEnd) {
  move(GetParam().make(kAllow));
  scenario->driver().halt(scenario->now());
  scenario->run(0.02);
  send("000#8002");
  expect_rest_at_the_end("");
  expect_recovery();
}

// Neither PDO nor SDO reaches it: it plays what it has, and nobody says that the arm rests before.
TEST_P(CanArm, DriveThatCannotBeReachedCountsAsMoving) {
  move(GetParam().make(kAllow));
  inject("can0", "drop_id 0x602 100000");
  send("000#8002");
  expect_rest_at_the_end("put in pre-operational by another node (NMT");
  inject("can0", "drop_id 0x602 0");
  scenario->run(1.0);
  expect_recovery();
}

// A drive that takes no controlword by PDO (0x1401:1 invalid, or 0x1601) is halted all the same.
TEST_P(CanArm, HaltGoesBySdoWhereThePdoHasNoEffect) {
  move(GetParam().make(kChangeable));
  send("602#2301140102030080");
  scenario->run(0.05);
  scenario->driver().halt(scenario->now());
  expect_rest_at_the_end("");
}

// What a drive does not report any more is missed at rest.
TEST_P(CanArm, PositionsThatDoNotComeAtRestAreAFault) {
  stand(GetParam().make(kChangeable));
  const bool epos = std::string(GetParam().name) == "Epos";
  send(epos ? "602#2301180182020080" : "602#2300180182010080");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 0.7));
  EXPECT_TRUE(contains(scenario->snapshot().fault, "joint2 (can0 node 2)")) << scenario->snapshot().fault;
  EXPECT_TRUE(contains(scenario->snapshot().fault, "PDOs have been changed")) << scenario->snapshot().fault;
  expect_recovery();
}

TEST_P(CanArm, ModeThatIsChangedAtRestIsAFault) {
  stand(GetParam().make(kAllow));
  const bool epos = std::string(GetParam().name) == "Epos";
  send(epos ? "602#2F60600001000000" : "602#2F60600000000000");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 0.1));
  EXPECT_TRUE(contains(scenario->snapshot().fault, "0x6061")) << scenario->snapshot().fault;
  expect_recovery();
}

TEST_P(CanArm, DriveThatIsSwitchedOffAtRestIsAFault) {
  stand(GetParam().make(kAllow));
  send("602#2B40600006000000");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 0.1));
  EXPECT_TRUE(contains(scenario->snapshot().fault, "left operation enabled")) << scenario->snapshot().fault;
  expect_recovery();
}

// 0x1401: the controlword does not arrive, or is not obeyed at SYNC.
TEST_P(CanArm, PdosThatWereChangedWhileItWasOffAreNotEnabled) {
  const std::pair<const char*, const char*> changes[] = {{"602#2301140102030080", "0x1401:01"},
                                                         {"602#2F011402FF000000", "0x1401:02"}};
  for (const auto& [frame, object] : changes) {
    stand(GetParam().make(kChangeable));
    ASSERT_TRUE(scenario->result_of_request(scenario->driver().enable(false, scenario->now())).success);
    send(frame);
    scenario->run(0.1);
    const auto enabled = scenario->result_of_request(scenario->driver().enable(true, scenario->now()));
    EXPECT_FALSE(enabled.success);
    EXPECT_TRUE(contains(enabled.message, "joint2 (can0 node 2)")) << enabled.message;
    EXPECT_TRUE(contains(enabled.message, object)) << enabled.message;
    EXPECT_FALSE(scenario->driver().emulated_power(kJoint2).value());
    expect_recovery();
  }
}

// Each answer comes after sdo_timeout (0.2 s): at rest that is waited for.
TEST_P(CanArm, DriveThatAnswersLateIsWaitedFor) {
  scenario = std::make_unique<Scenario>(
      GetParam().make("{drives: {joint2: {emulation: {sdo_response_time: 0.3}}}}"));
  EXPECT_TRUE(scenario->run_until_state(GroupState::Idle, 120.0)) << scenario->snapshot().fault;
}

TEST_P(CanArm, DriveThatAnswersMuchTooLateIsToldWithTheParameter) {
  scenario = std::make_unique<Scenario>(
      GetParam().make("{drives: {joint2: {emulation: {sdo_response_time: 3.0}}}}"));
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 30.0));
  EXPECT_TRUE(contains(scenario->snapshot().fault, "sdo_timeout")) << scenario->snapshot().fault;
}

TEST_P(CanArm, TwoDevicesWithOneNodeIdAreNamed) {
  scenario = std::make_unique<Scenario>(GetParam().make(""));
  inject("can0", "repeat_id 0x582 1000");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 2.0));
  EXPECT_TRUE(contains(scenario->snapshot().fault, "two devices answer as node 2"))
      << scenario->snapshot().fault;
  inject("can0", "repeat_id 0x582 0");
  expect_recovery();
}

// The rule of CAN that lets a receiver see a frame twice.
TEST_P(CanArm, FrameThatComesTwiceMakesNoTwoDevices) {
  scenario = std::make_unique<Scenario>(GetParam().make(""));
  inject("can0", "repeat_id 0x582 2");
  EXPECT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
}

TEST_P(CanArm, FirstCauseStaysWhenADriveInFaultIsReset) {
  stand(GetParam().make(kAllow));
  inject("joint2", "emcy 0x4210");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 0.1));
  send("000#8102");
  scenario->run(3.0);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "0x4210")) << scenario->snapshot().fault;
  expect_recovery();
}

INSTANTIATE_TEST_SUITE_P(CanDrives, CanArm, ::testing::ValuesIn(kArms),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace interpolated_motion::test
