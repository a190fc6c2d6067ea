#include <cmath>
#include <ostream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"
#include "hardware/scenario.h"
#include "hardware/silverlode/line_traffic.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

// Numbers of commands, as facts about the protocol have them.
constexpr int kPol = 0;
constexpr int kWri = 11;
constexpr int kRrg = 12;
constexpr int kRis = 20;
constexpr int kRio = 21;
constexpr int kImw = 25;
constexpr int kErl = 151;
constexpr int kCis = 163;
constexpr int kKmc = 167;
constexpr int kEmd = 227;
constexpr int kIms = 253;
constexpr int kImq = 254;
constexpr int kForEver = 1'000'000;

void refuse(Scenario& scenario, const std::string& joint, int command, int code, int count) {
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject(joint, fmt::format("nak {} {} {}", command, code, count), &reason,
                                       scenario.now()))
      << reason;
}

// What a goal asks of the motor.

/// Both joints over the same distance in the same time, on a cubic with 1.5 times the mean velocity.
trajectory::Goal one_step(double distance, double seconds) {
  const double way = distance;
  return make_goal({seconds}, {{way, way, way, way, way, way}});
}

void expect_refused(Scenario& scenario, const trajectory::Goal& goal, const std::vector<std::string>& parts) {
  LineTraffic traffic(scenario);
  const auto answer = scenario.submit(goal);
  ASSERT_FALSE(answer);
  for (const std::string& part : parts)
    EXPECT_TRUE(contains(answer.error().text, part)) << answer.error().text;
  scenario.run(0.5);
  EXPECT_EQ(traffic.commands(kImw), 0U);
  for (const double position : scenario.positions()) EXPECT_EQ(position, 0.0);
}

std::string every_joint(const std::string& changes) {
  std::string drives;
  for (int i = 1; i <= 6; ++i) drives += fmt::format("joint{}: {}, ", i, changes);
  return "{drives: {" + drives + "}}";
}

// 3 rad/s are allowed to the joint, but with a ratio of 200 they are 5730 rpm of the motor.
TEST(SilverlodeBadGoal, FasterThanASegmentCanSay) {
  Scenario scenario(six_axis_silverlode(every_joint("{gear_ratio: 200}")));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  expect_refused(scenario, one_step(2.0, 1.0), {"joint1", "rpm of the motor", "4000"});
}

// 2^30 of 2^31 = 2000 rpm a tick are 1000 rpm a tick, 17453 rad/s^2 of the joint with a ratio of 50.
TEST(SilverlodeBadGoal, MoreAccelerationThanASegmentCanSay) {
  Scenario scenario(six_axis_silverlode(every_joint("{limits: {max_acceleration: 1.0e6}}")));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  expect_refused(scenario, one_step(0.0005, 0.00025), {"joint1", "rpm/s of the motor"});
}

// Refusals of the drive at bring-up.

struct Refused {
  int command;
  const char* name;
};

class RefusalAtBringUp : public testing::TestWithParam<Refused> {};

TEST_P(RefusalAtBringUp, WithAnyCodeIsNamed) {
  for (int code = 1; code <= 11; ++code) {
    Scenario scenario(six_axis_silverlode("{bring_up_timeout: 1.0}"));
    refuse(scenario, "joint2", GetParam().command, code, kForEver);
    scenario.run_until_state(GroupState::Fault, 10.0);
    const auto snapshot = scenario.snapshot();
    // IMW refused as "full" at once is a queue without a place; as anything else it is as the others are.
    ASSERT_EQ(snapshot.state, GroupState::Fault) << "NAK " << code;
    EXPECT_TRUE(contains(snapshot.fault, "Joint joint2 (line0 address 17)")) << snapshot.fault;
    EXPECT_TRUE(contains(snapshot.fault, GetParam().name)) << snapshot.fault;
    EXPECT_TRUE(contains(snapshot.fault, fmt::format("NAK {} (", code))) << snapshot.fault;
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, RefusalAtBringUp,
                         testing::Values(Refused{kPol, "POL"}, Refused{kWri, "WRI"}, Refused{kRrg, "RRG"},
                                         Refused{kRis, "RIS"}, Refused{kRio, "RIO"}, Refused{kImw, "IMW"},
                                         Refused{kErl, "ERL"}, Refused{kCis, "CIS"}, Refused{kKmc, "KMC"},
                                         Refused{kEmd, "EMD"}, Refused{kImq, "IMQ"}),
                         [](const testing::TestParamInfo<Refused>& refused) { return refused.param.name; });

// Refusals of the drive in motion.

class RefusalInMotion : public FaultInMotion, public testing::WithParamInterface<int> {
 protected:
  void SetUp() override { move(six_axis_silverlode()); }
};

TEST_P(RefusalInMotion, OfOneSegmentCostsNothing) {
  refuse(*scenario, "joint2", kImw, GetParam(), 1);
  const auto result = scenario->result_of(goal);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  for (const auto& joint : scenario->driver().report().joints) EXPECT_LE(joint.worst_deviation, 2.0);
  EXPECT_EQ(scenario->snapshot().joints[1].refused_writes, 1U);
}

TEST_P(RefusalInMotion, OfEverySegmentStopsTheGroup) {
  refuse(*scenario, "joint2", kImw, GetParam(), kForEver);
  const auto result = scenario->result_of(goal);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_TRUE(contains(result.text, "Joint joint2 (line0 address 17)")) << result.text;
  scenario->run(2.0);
  const auto rest = scenario->positions();
  scenario->run(1.0);
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(scenario->positions()[i], rest[i], 2e-4);
}

TEST_P(RefusalInMotion, OfEveryLookStopsTheGroup) {
  refuse(*scenario, "joint2", kRrg, GetParam(), kForEver);
  const auto result = scenario->result_of(goal);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted) << "nobody knows where the drive is";
  EXPECT_TRUE(contains(result.text, "Joint joint2 (line0 address 17)")) << result.text;
}

INSTANTIATE_TEST_SUITE_P(Codes, RefusalInMotion, testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));

class RefusalOfTheStart : public testing::TestWithParam<int> {};

TEST_P(RefusalOfTheStart, IsNamedAndNothingMoves) {
  Scenario scenario(six_axis_silverlode());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  refuse(scenario, "joint5", kIms, GetParam(), kForEver);
  const auto accepted = scenario.submit(one_step(0.2, 1.0));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_TRUE(contains(result.text, "Joint joint5 (line1 address 20)")) << result.text;
  EXPECT_TRUE(contains(result.text, fmt::format("NAK {} (", GetParam()))) << result.text;
  scenario.run(1.0);
  for (const double position : scenario.positions())
    EXPECT_LE(std::abs(position), 1e-6) << "all of them still waited for the common start";
}

INSTANTIATE_TEST_SUITE_P(Codes, RefusalOfTheStart, testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));

// Lines that are no answer.

struct StrangeLine {
  const char* name;
  std::string text;
  const char* in_the_log;

  friend std::ostream& operator<<(std::ostream& out, const StrangeLine& line) { return out << line.name; }
};

class StrangeLines : public FaultInMotion, public testing::WithParamInterface<StrangeLine> {};

// Ten times in a goal, on a line whose wires are apart: what the drives receive is as it was sent. Mostly
// they meet the silence between two exchanges or garble an answer that is asked for again; where they garble
// the answer to a segment, the group stops and says so. Of three goals one at least does not begin with that.
TEST_P(StrangeLines, AreToldAndNeverTakenForAnAnswer) {
  bool told = false;
  for (const double start : {0.45, 0.5, 0.55}) {
    move(six_axis_silverlode("{buses: {line0: {wiring: rs232}}}"), start);
    for (int i = 0; i < 10 && scenario->state() == GroupState::Moving; ++i) {
      inject("line0", "garbage " + GetParam().text);
      scenario->run(0.2 + 0.0037 * i);
    }
    const auto result = scenario->result_of(goal);
    for (const auto& joint : scenario->driver().report().joints)
      EXPECT_LE(joint.worst_deviation, 2.0) << joint.joint;
    if (result.outcome != GoalOutcome::Succeeded) {
      EXPECT_TRUE(contains(result.text, "cannot be known")) << result.text;
    }
    for (const std::string& line : scenario->log()) told = told || contains(line, GetParam().in_the_log);
  }
  EXPECT_TRUE(told);
}

const StrangeLine kStrangeLines[] = {
    {"Garbage", "xyz!*\r", "line0: a line that is no reply"},
    {"OverLong", "# 10 000C" + std::string(300, '0') + "\r", "line0: a line that is no reply"},
    {"Truncated", "# 10 00", "line0: a line that is no reply"},
    {"OtherAddress", "* 63\r", "line0: a reply "},
    {"OtherCommand", "# 10 00C8 0001\r", "line0: a reply "},
    {"OtherRefusal", "! 10 00C8 0001\r", "line0: a reply "},
};

INSTANTIATE_TEST_SUITE_P(Lines, StrangeLines, testing::ValuesIn(kStrangeLines),
                         [](const testing::TestParamInfo<StrangeLine>& line) { return line.param.name; });

// Drives and parameters that do not fit.

TEST(SilverlodeBringUp, RevisionIsShownWhateverItIs) {
  Scenario scenario(six_axis_silverlode("{drives: {joint1: {emulation: {revision: 1, queue_depth: 4}}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  bool shown = false;
  for (const std::string& line : scenario.log()) {
    shown = shown ||
            contains(line, "Joint joint1 (line0 address 16): SilverLode drive, revision 0001, queue of 4");
  }
  EXPECT_TRUE(shown);
}

// The configuration says eight places, as from revision 06 on; the drive is older and has four. "Full" comes
// earlier than expected, yet nothing is lost.
TEST(SilverlodeBringUp, WrongDepthInTheConfigurationCostsRefusalsOnly) {
  Scenario scenario(
      six_axis_silverlode("{drives: {joint1: {queue_depth: 8, emulation: {revision: 5, queue_depth: 4}}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  for (const auto& joint : scenario.driver().report().joints) EXPECT_LE(joint.worst_deviation, 2.0);
  EXPECT_GT(scenario.snapshot().joints[0].refused_writes, 0U);
}

struct BadParameter {
  const char* name;
  const char* changes;
  std::vector<std::string> parts;
};

class BadSilverlodeParameter : public testing::TestWithParam<BadParameter> {};

TEST_P(BadSilverlodeParameter, IsRefusedWithValueAndRange) {
  try {
    Scenario scenario(six_axis_silverlode(GetParam().changes));
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    for (const std::string& part : GetParam().parts)
      EXPECT_TRUE(contains(error.what(), part)) << error.what();
  }
}

const BadParameter kBadParameters[] = {
    {"Address", "{drives: {joint2: {address: 255}}}", {"drives/joint2/address", "255", "1..254"}},
    {"AddressTwice", "{drives: {joint2: {address: 16}}}", {"16", "line0"}},
    {"Depth", "{drives: {joint2: {queue_depth: 17}}}", {"drives/joint2/queue_depth", "17", "0..16"}},
    {"Arguments", "{drives: {joint2: {ims_arguments: \"0 x\"}}}", {"drives/joint2/ims_arguments", "0 x"}},
    {"Tick", "{drives: {joint2: {tick: 0.1}}}", {"drives/joint2/tick", "0.1"}},
    {"FullScale",
     "{drives: {joint2: {velocity_full_scale: 0}}}",
     {"drives/joint2/velocity_full_scale", "0", "1.."}},
    {"Baud", "{buses: {line0: {baud: 12345}}}", {"buses/line0/baud", "12345", "57600"}},
    {"Timeout", "{buses: {line0: {reply_timeout: 0.001}}}", {"buses/line0/reply_timeout", "turnaround"}},
    {"StatusPeriod", "{buses: {line0: {status_period: 1}}}", {"buses/line0/status_period", "1", "0.25"}},
    {"Revision", "{drives: {joint2: {emulation: {revision: 70000}}}}", {"revision", "70000", "65535"}},
};

INSTANTIATE_TEST_SUITE_P(Cases, BadSilverlodeParameter, testing::ValuesIn(kBadParameters),
                         [](const testing::TestParamInfo<BadParameter>& bad) { return bad.param.name; });

}  // namespace
}  // namespace interpolated_motion::test
