#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fuzz/support/tapped_kind.h"
#include "hardware/fault_in_motion.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/hardware/silverlode/configuration.h"

// Two drives with one address on one line, as when a drive is exchanged and its address not set: both obey,
// and both answer.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr const char* kSharer = "joint2";  // on line0 with two others

/// SilverLode drives, of which one shares its address with a drive that is not configured.
class SharedAddressKind : public fuzz::TappedKind {
 public:
  /// The second drive answers `later` (s) than the first, and is switched off when it is `absent`.
  SharedAddressKind(const hardware::DriveKind& kind, fuzz::Buses& buses, double later, bool absent)
      : TappedKind(kind, buses), kind_(kind), later_(later), absent_(absent) {}

  emulation::Drive& make_emulated(const hardware::DriveConfiguration& drive, emulation::World& world,
                                  hardware::EmulatedBus bus) const override {
    if (drive.joint == kSharer) {
      auto settings = std::make_shared<hardware::SilverlodeSettings>(
          hardware::settings_of<hardware::SilverlodeSettings>(drive));
      settings->emulated.turnaround += host_duration(later_);
      settings->emulated.initial_position += 12345;
      hardware::DriveConfiguration second = drive;
      second.settings = settings;
      second_ = &dynamic_cast<emulation::SilverDust&>(kind_.make_emulated(second, world, bus));
      if (absent_) second_->silence(true, HostTime{});
    }
    return kind_.make_emulated(drive, world, bus);
  }

  emulation::SilverDust& second() const { return *second_; }

 private:
  const hardware::DriveKind& kind_;
  double later_;
  bool absent_;
  mutable emulation::SilverDust* second_ = nullptr;
};

/// The parameter: s by which the second drive answers later.
class SharedAddress : public ::testing::TestWithParam<double> {
 protected:
  void start(bool absent) {
    for (const hardware::DriveKind* kind : hardware::drive_kinds()) {
      if (std::string(kind->name()) != "silverlode_ims") continue;
      kind_ = std::make_unique<SharedAddressKind>(*kind, buses_, GetParam(), absent);
    }
    scenario = std::make_unique<Scenario>(six_axis_silverlode(), hardware::DriveKinds{kind_.get()});
  }

  void appear() { kind_->second().silence(false, scenario->now()); }

  void move_and_appear() {
    start(true);
    ASSERT_TRUE(scenario->run_until_state(GroupState::Idle, 30.0)) << scenario->snapshot().fault;
    const auto accepted = scenario->submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
    ASSERT_TRUE(accepted) << accepted.error().text;
    goal_ = accepted.value().id;
    ASSERT_TRUE(scenario->run_until_state(GroupState::Moving));
    scenario->run(1.0);
    appear();
  }

  void expect_told(const std::string& text) {
    EXPECT_TRUE(contains(text, "Joint joint2 (line0 address 17)")) << text;
    EXPECT_TRUE(contains(text, "share address 17")) << text;
  }

 private:
  fuzz::Buses buses_;
  std::unique_ptr<SharedAddressKind> kind_;

 protected:
  std::unique_ptr<Scenario> scenario;
  motion::GoalId goal_ = 0;
};

TEST_P(SharedAddress, IsToldAtBringUp) {
  start(false);
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 30.0));
  expect_told(scenario->snapshot().fault);
}

TEST_P(SharedAddress, IsToldAtRest) {
  start(true);
  ASSERT_TRUE(scenario->run_until_state(GroupState::Idle, 30.0)) << scenario->snapshot().fault;
  appear();
  ASSERT_TRUE(scenario->run_until_state(GroupState::Fault, 5.0));
  expect_told(scenario->snapshot().fault);
  EXPECT_FALSE(scenario->submit(make_goal({2.0}, {{0.1, 0.1, 0.1, 0.1, 0.1, 0.1}})));
}

TEST_P(SharedAddress, IsToldInMotion) {
  move_and_appear();
  const auto result = scenario->result_of(goal_, 5.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  expect_told(result.text);
}

class SharedAddressAtAnyDelay : public SharedAddress {};

TEST_P(SharedAddressAtAnyDelay, StopsTheMotion) {
  move_and_appear();
  EXPECT_EQ(scenario->result_of(goal_, 5.0).outcome, GoalOutcome::Aborted);
  const auto rest = scenario->positions();
  scenario->run(1.0);
  for (const std::size_t i : {0U, 2U, 3U, 4U, 5U})
    EXPECT_NEAR(scenario->positions()[i], rest[i], 1e-4) << "joint" << i + 1;
}

// Replies that overlap, as those of two drives of one make do.
INSTANTIATE_TEST_SUITE_P(Overlapping, SharedAddress, ::testing::Values(0.0003, 0.001));
INSTANTIATE_TEST_SUITE_P(Delays, SharedAddressAtAnyDelay,
                         ::testing::Values(0.0, 0.0003, 0.001, 0.0025, 0.004, 0.006, 0.009, 0.015));

}  // namespace
}  // namespace interpolated_motion::test
