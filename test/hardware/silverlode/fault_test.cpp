#include <cmath>
#include <random>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"
#include "hardware/setpoint_streaming.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

/// Longest until a look at a drive reveals a fault: three drives share a line that segments keep busy.
constexpr double kNotice = 0.5;

class SilverlodeFaultInMotion : public FaultInMotion {
 protected:
  void move(const std::string& changes = "", double for_seconds = 2.0) {
    FaultInMotion::move(six_axis_silverlode(changes), for_seconds);
  }
};

TEST_F(SilverlodeFaultInMotion, FaultOfOneDriveStopsTheGroup) {
  move();
  inject("joint3", "fault moving_error");
  expect_stop("Joint joint3 (line0 address 18)", kNotice);
  expect_recovery();
}

TEST_F(SilverlodeFaultInMotion, BlockedAxisStopsTheGroupWithAMovingError) {
  move("{drives: {joint2: {max_following_error: 0.02}}}");
  inject("joint2", "stall 1");
  expect_stop("moving error", 1.0);
  inject("joint2", "stall 0");
  scenario->run(1.0);
  expect_recovery();
}

TEST_F(SilverlodeFaultInMotion, RestartOfADriveStopsTheGroup) {
  move();
  inject("joint5", "power_cycle 0.1");
  expect_stop("Joint joint5 (line1 address 20)", 1.0, 4);
  scenario->run(2.0);
  expect_recovery();
}

TEST_F(SilverlodeFaultInMotion, LostDriveStopsTheGroupAndRunsDryByItself) {
  move();
  inject("joint1", "silence 1");
  expect_stop("Joint joint1", 1.0, 0);
  inject("joint1", "silence 0");
  scenario->run(3.0);
  const double rest = scenario->positions()[0];
  scenario->run(1.0);
  EXPECT_NEAR(scenario->positions()[0], rest, 1e-6) << "register 19 has not stopped the drive";
  expect_recovery();
}

/// On both lines, s.
std::string with_reply_timeout(const char* timeout) {
  return fmt::format("{{buses: {{line0: {{reply_timeout: {0}}}, line1: {{reply_timeout: {0}}}}}}}", timeout);
}

/// A drive that does not answer takes the line's time, up to repeats + 2 times reply_timeout: the others have
/// motion for so long, and the fault is that of the drive that is silent.
class SilentDriveOfALine : public FaultInMotion, public testing::WithParamInterface<const char*> {};

TEST_P(SilentDriveOfALine, IsTheCauseAndStarvesNoOther) {
  for (const char* const command : {"silence 1", "power_cycle 0.2", "power_cycle 30"}) {
    move(six_axis_silverlode(with_reply_timeout(GetParam())));
    inject("joint5", command);
    expect_stop("Joint joint5 (line1 address 20)", 2.5, 4);
    for (const auto& joint : scenario->snapshot().joints) EXPECT_EQ(joint.underruns, 0U) << command;
  }
}

class SilentDriveInAStream : public SetpointStreaming, public testing::WithParamInterface<const char*> {};

// A stream has less ahead, so another drive may run dry first; the cause is told all the same.
TEST_P(SilentDriveInAStream, IsNamed) {
  start(six_axis_silverlode(with_reply_timeout(GetParam())), 0.1);
  stream(2.0, with_loss(0.0, 1));
  std::string reason;
  ASSERT_TRUE(scenario->driver().inject("joint5", "silence 1", &reason, scenario->now())) << reason;
  for (double t = 2.0; t < 12.0 && scenario->state() != GroupState::Fault; t += kPeriod) {
    send(setpoint(begin + host_duration(t), position_at(t)));
    run(kPeriod);
  }
  EXPECT_EQ(scenario->state(), GroupState::Fault);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "line1 address 20")) << scenario->snapshot().fault;
}

INSTANTIATE_TEST_SUITE_P(ReplyTimeout, SilentDriveInAStream, testing::Values("0.02", "0.1", "0.2", "0.5"));
INSTANTIATE_TEST_SUITE_P(ReplyTimeout, SilentDriveOfALine, testing::Values("0.02", "0.1", "0.2", "0.5"));

TEST_F(SilverlodeFaultInMotion, CutCableStopsEveryDriveOfTheLineByItself) {
  move();
  inject("line0", "disconnect 1");
  const auto result = scenario->result_of(goal);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  scenario->run(3.0);
  inject("line0", "disconnect 0");
  expect_recovery();
}

TEST_F(SilverlodeFaultInMotion, GarbageOnTheLineIsSurvived) {
  move();
  for (int i = 0; i < 5; ++i) {
    inject("line0", "garbage xyz!* 10");
    scenario->run(0.05);
  }
  const auto result = scenario->result_of(goal);
  if (result.outcome == GoalOutcome::Succeeded) {
    for (const auto& joint : scenario->driver().report().joints) EXPECT_LE(joint.worst_deviation, 2.0);
  } else {
    EXPECT_TRUE(contains(result.text, "cannot be known")) << result.text;
  }
}

// Characters vanish on their way at any time: requests or replies, of status, of segments, of anything.
// Either the path is followed to the end, every tick of it, or the group stops with a sentence that says why;
// never does a segment get lost or into a queue twice. Only what is left of a request may be another segment:
// that is noticed, see ChangedSegments.
class LostReplies : public testing::TestWithParam<unsigned> {};

/// rad that a drive may be beside its path until a changed segment has been seen at two looks.
constexpr double kNoticed = 0.25;

TEST_P(LostReplies, LeadToThePathOrToAStop) {
  std::mt19937 random(GetParam());
  Scenario scenario(six_axis_silverlode("{commit_horizon: 2}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  const bool requests = random() % 2 == 0;
  for (int i = 0; i < 3 && scenario.state() == GroupState::Moving; ++i) {
    scenario.run(0.3 + 1e-3 * static_cast<double>(random() % 1000));
    std::string reason;
    const std::string command = requests ? "lose_requests " : "lose_replies ";
    ASSERT_TRUE(scenario.driver().inject(random() % 2 == 0 ? "line0" : "line1",
                                         command + std::to_string(1 + random() % 20), &reason,
                                         scenario.now()))
        << reason;
  }
  const auto result = scenario.result_of(accepted.value().id);
  const bool changed = requests && contains(result.text, "a segment was changed or lost on the line");
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_LE(joint.worst_deviation, changed ? kNoticed / joint.count : 2.0) << joint.joint;
  }
  if (result.outcome == GoalOutcome::Succeeded) return;
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_TRUE(changed || contains(result.text, "cannot be known") || contains(result.text, "garbled") ||
              contains(result.text, "does not answer") || contains(result.text, "no reply"))
      << result.text;
}

INSTANTIATE_TEST_SUITE_P(Seeds, LostReplies, testing::Range(0U, 24U));

// Characters vanish on their way to the drives, and what is left of a segment may be one that the drive
// takes.
class ChangedSegments : public testing::TestWithParam<std::tuple<unsigned, bool>> {};

TEST_P(ChangedSegments, AreNoticedByWhereTheyLead) {
  const auto [seed, target_in_motion] = GetParam();
  constexpr double kFollowing = 0.02;  // rad
  std::mt19937 random(seed);
  std::string drives;
  for (int i = 1; i <= 6; ++i) {
    drives += fmt::format("joint{}: {{max_following_error: {}, target_in_motion: {}}}, ", i, kFollowing,
                          target_in_motion);
  }
  Scenario scenario(six_axis_silverlode("{drives: {" + drives + "}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  for (int i = 0; i < 6 && scenario.state() == GroupState::Moving; ++i) {
    scenario.run(0.2 + 1e-3 * static_cast<double>(random() % 500));
    std::string reason;
    ASSERT_TRUE(scenario.driver().inject(random() % 2 == 0 ? "line0" : "line1",
                                         "lose_requests " + std::to_string(1 + random() % 3), &reason,
                                         scenario.now()))
        << reason;
  }
  const auto result = scenario.result_of(accepted.value().id);
  // As soon as it has been looked at twice. When the motion is over no more is left of it than an axis may
  // follow behind, where register 0 does not tell.
  const bool at_the_end = contains(result.text, "after the motion");
  EXPECT_FALSE(at_the_end && target_in_motion) << result.text;
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_LE(joint.worst_deviation * joint.count, at_the_end ? 1.1 * kFollowing : kNoticed)
        << joint.joint << ": " << result.text;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ChangedSegments, testing::Combine(testing::Range(40U, 72U), testing::Bool()));

// What register 0 is in motion is in no document: a drive in which it is something else is told so, and moves
// with the parameter.
TEST(TargetInMotion, IsAParameter) {
  const std::string other = "emulation: {target_in_motion: false}";
  for (const bool told : {false, true}) {
    const std::string drive = "{" + other + (told ? ", target_in_motion: false}" : "}");
    Scenario scenario(six_axis_silverlode("{drives: {joint2: " + drive + "}}"));
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
    const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
    ASSERT_TRUE(accepted) << accepted.error().text;
    const auto result = scenario.result_of(accepted.value().id);
    EXPECT_EQ(result.outcome, told ? GoalOutcome::Succeeded : GoalOutcome::Aborted) << result.text;
    EXPECT_EQ(contains(result.text, "target_in_motion: false"), !told) << result.text;
  }
}

TEST(SilverlodeBringUp, MissingDriveIsNamed) {
  Scenario scenario(six_axis_silverlode("{drives: {joint2: {emulation: {missing: true}}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Fault, 20.0));
  EXPECT_TRUE(contains(scenario.snapshot().fault, "Joint joint2 (line0 address 17)"))
      << scenario.snapshot().fault;
  EXPECT_TRUE(contains(scenario.snapshot().fault, "no drive answers")) << scenario.snapshot().fault;
}

// The configuration has two addresses, but the switches of the second drive are those of the first.
TEST(SilverlodeBringUp, TwoDrivesOnOneAddressAreNoticed) {
  Scenario scenario(six_axis_silverlode(
      "{drives: {joint2: {emulation: {address: 16, initial_position: 1.0, clock_error_ppm: 50}}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Fault, 30.0));
  EXPECT_TRUE(contains(scenario.snapshot().fault, "address 1")) << scenario.snapshot().fault;
}

TEST(SilverlodeBringUp, DepthOfTheQueueIsMeasured) {
  Scenario scenario(six_axis_silverlode("{drives: {joint1: {emulation: {queue_depth: 4}}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  EXPECT_EQ(scenario.snapshot().joints[0].capacity, 4U);
  EXPECT_EQ(scenario.snapshot().joints[1].capacity, 8U);
}

TEST(SilverlodeBringUp, OldRevisionWithoutMultiRegisterReadsWorks) {
  const std::string old = "{emulation: {multi_register_read: false, queue_depth: 4, revision: 5}}";
  std::string changes;
  for (int i = 1; i <= 6; ++i) changes += (i > 1 ? ", joint" : "joint") + std::to_string(i) + ": " + old;
  Scenario scenario(six_axis_silverlode("{drives: {" + changes + "}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(make_goal({2.0}, {{0.5, 0.4, 0.3, 0.2, 0.1, -0.5}}));
  ASSERT_TRUE(accepted) << accepted.error().text;
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
}

}  // namespace
}  // namespace interpolated_motion::test
