#include <chrono>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "hardware/scenario.h"
#include "hardware/standstill/drive_kind.h"

// A kind of drive that the driver does not have: it lives in this folder, made by docs/architecture.md,
// "Adding a kind of drive". Its group has a drive of another kind, on the same bus.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;
using std::chrono::milliseconds;

constexpr double kHere = 0.25;  // rad, where it stands

hardware::Configuration configuration(const std::string& type = "standstill") {
  YAML::Node yaml = arm_of(2);
  yaml["drives"]["joint2"]["type"] = type;
  yaml["drives"]["joint2"]["emulation"]["initial_position"] = kHere;
  hardware::DriveKinds kinds = hardware::drive_kinds();
  kinds.push_back(&standstill_kind());
  return hardware::parse_configuration(yaml, six_axis_urdf(), {}, kinds);
}

class Standstill : public testing::Test {
 protected:
  bool run_until(const std::function<bool()>& condition, double limit = 10.0) {
    for (const HostTime end = now + host_duration(limit); now < end && !condition();) {
      now += milliseconds(5);
      driver.update(now);
    }
    return condition();
  }

  GroupState state() {
    motion::Snapshot snapshot;
    driver.snapshot(snapshot);
    return snapshot.state;
  }

  void SetUp() override {
    ASSERT_TRUE(run_until([this] { return state() == GroupState::Idle; }));
  }

  motion::GoalResult result() {
    std::optional<motion::GoalResult> ended;
    EXPECT_TRUE(run_until([&] { return ended || (ended = driver.take_goal_result()); }));
    return ended.value_or(motion::GoalResult{});
  }

  HostTime now{};
  hardware::MotionHardware driver{configuration(), HostTime{}};
};

TEST_F(Standstill, TakesPartInAGoalToWhereItStands) {
  driver.read(now, HostDuration{0});
  EXPECT_NEAR(*driver.joints()[1].position, kHere, 1e-4);
  const auto accepted = driver.submit(make_goal({1.0, 2.0}, {{0.2, kHere}, {0.5, kHere}}), now);
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto ended = result();
  EXPECT_EQ(ended.outcome, GoalOutcome::Succeeded) << ended.text;
  EXPECT_NEAR(*driver.emulated_position(0), 0.5, 1e-3);
  EXPECT_NEAR(*driver.emulated_position(1), kHere, 1e-4);
  const auto report = driver.report();
  EXPECT_GT(report.joints[1].samples, 100U);
  EXPECT_LE(report.joints[1].worst_deviation, 1.0);
}

TEST_F(Standstill, RefusesToBeMoved) {
  const auto accepted = driver.submit(make_goal({1.0}, {{0.2, kHere + 0.1}}), now);
  ASSERT_FALSE(accepted);
  EXPECT_NE(accepted.error().text.find("stands still"), std::string::npos) << accepted.error().text;
  EXPECT_NEAR(*driver.emulated_position(0), 0.0, 1e-4);
}

TEST_F(Standstill, ObeysItsFaults) {
  std::string reason;
  EXPECT_TRUE(driver.inject("joint2", "silence 1", &reason, now)) << reason;
  EXPECT_TRUE(run_until([this] { return state() == GroupState::Fault; }));
  EXPECT_FALSE(driver.inject("joint2", "wedge nan", &reason, now));
  EXPECT_EQ(reason, "\"wedge nan\": COUNTS is nan; it must be a whole number within -1000000..1000000");
  EXPECT_FALSE(driver.inject("joint2", "explode", &reason, now));
  EXPECT_NE(reason.find("known: wedge COUNTS, power_cycle SECONDS"), std::string::npos) << reason;
}

TEST(StandstillKind, IsOneMoreWordOfTheConfiguration) {
  try {
    configuration("jumping");
    FAIL() << "was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "Parameter drives/joint2/type is \"jumping\"; allowed: epos_ipm, silverlode_ims, cyclic, "
                 "standstill.");
  }
}

}  // namespace
}  // namespace interpolated_motion::test
