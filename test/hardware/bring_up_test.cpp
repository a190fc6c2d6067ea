#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GroupState;

/// Brings up an arm of two with `emulation` for joint2, and returns what the group says.
motion::Snapshot bring_up(const std::string& emulation, double seconds = 8.0) {
  Scenario scenario(arm_of(2, "{bring_up_timeout: 1.0, drives: {joint2: {emulation: " + emulation + "}}}"));
  scenario.run_until(
      [&] { return scenario.state() == GroupState::Idle || scenario.state() == GroupState::Fault; }, seconds);
  return scenario.snapshot();
}

void expect_fault(const std::string& emulation, const std::vector<std::string>& parts) {
  const auto snapshot = bring_up(emulation);
  EXPECT_EQ(snapshot.state, GroupState::Fault);
  EXPECT_NE(snapshot.fault.find("Joint joint2 (can0 node 2)"), std::string::npos) << snapshot.fault;
  for (const std::string& part : parts)
    EXPECT_NE(snapshot.fault.find(part), std::string::npos) << snapshot.fault;
}

TEST(BringUp, MissingDriveIsNamedWithWhatToCheck) {
  expect_fault("{missing: true}", {"no drive answers", "node id"});
}

TEST(BringUp, DriveOfAnotherVendorIsRefused) { expect_fault("{vendor_id: 0x9A}", {"0x0000009A", "maxon"}); }

TEST(BringUp, Epos4IsRefusedByName) {
  expect_fault("{variant: epos4}", {"EPOS4", "Interpolated Position Mode"});
}

TEST(BringUp, DriveThatBootsLateIsWaitedFor) {
  EXPECT_EQ(bring_up("{boot_time: 0.9}").state, GroupState::Idle);
}

TEST(BringUp, DrivesAreNotEnabledUnlessAsked) {
  Scenario scenario(arm_of(2, "{enable_on_start: false}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Disabled));
  scenario.run(2.0);
  EXPECT_EQ(scenario.snapshot().joints[0].state, "switch on disabled");
  const auto refused = scenario.submit(make_goal({1.0}, {{0.1, 0.1}}));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("~enable"), std::string::npos) << refused.error().text;
  EXPECT_TRUE(scenario.result_of_request(scenario.driver().enable(true, scenario.now())).success);
  EXPECT_EQ(scenario.snapshot().joints[0].statusword, 0x0737);
}

TEST(BringUp, FinestVelocityUnitTheDriveAcceptsIsTaken) {
  Scenario scenario(arm_of(2, "{drives: {joint2: {emulation: {limit_ranges_scale_with_notation: true}}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto said = [&](const std::string& text) {
    return std::any_of(scenario.log().begin(), scenario.log().end(),
                       [&](const std::string& line) { return line.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(
      said("Joint joint1 (can0 node 1): maxon EPOS2 70/10, firmware 0x2126, serial number 1, velocity unit 1 "
           "rpm"));
  EXPECT_TRUE(
      said("Joint joint2 (can0 node 2): maxon EPOS2 70/10, firmware 0x2126, serial number 2, velocity unit "
           "0.001 rpm"));
}

/// Whatever the documents leave open, the driver must cope with either answer.
class UnknownOfTheDrive : public ::testing::TestWithParam<const char*> {};

TEST_P(UnknownOfTheDrive, GoalIsPlayedAllTheSame) {
  Scenario scenario(arm_of(2, std::string("{drives: {joint1: {emulation: ") + GetParam() +
                                  "}, joint2: {emulation: " + GetParam() + "}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  std::vector<double> times;
  std::vector<std::vector<double>> positions;
  for (int i = 1; i <= 24; ++i) {
    times.push_back(0.3 * i);
    positions.push_back({0.3 * std::sin(0.7 * i), i == 24 ? 0.0 : 0.3 * std::sin(1.3 * i)});
  }
  const auto accepted = scenario.submit(make_goal(times, positions));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, motion::GoalOutcome::Succeeded) << result.text;
  for (const auto& joint : scenario.driver().report().joints) {
    EXPECT_LE(joint.worst_deviation, 1.0);
    EXPECT_EQ(joint.underruns, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Answers, UnknownOfTheDrive,
    ::testing::Values("{}", "{record_release: at_segment_start}", "{underflow_test: every_sample}",
                      "{free_records_pdo_mappable: false}", "{limits_scale_with_notation: false}",
                      "{limit_ranges_scale_with_notation: true}", "{lowest_velocity_notation: 0}",
                      "{lowest_velocity_notation: -1}", "{motion_check: knots}",
                      "{position_limit_check: per_record}", "{halt_release: needs_new_start}",
                      "{clock_error_ppm: 100}", "{clock_error_ppm: -100}", "{time_stamp_pdo_mappable: false}",
                      "{clock_discipline: false}", "{clock_error_ppm: 200, clock_slew: 0.0005}",
                      "{tick_phase: 0.0009}", "{lag_ms: 10}"));

}  // namespace
}  // namespace interpolated_motion::test
