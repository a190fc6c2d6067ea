#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/playback.h"
#include "hardware/scenario.h"

// EPOS2 sets its motion clock by SYNC and the time stamps in 0x1013: what the drives play is held against
// true time and against each other by the samples of the emulated drives.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

constexpr std::uint32_t kTimeStampId = 0x400 + 127;

/// `emulation` of each joint, `{}` where there is none.
std::string drives(const std::vector<std::string>& emulation) {
  std::string text = "{drives: {";
  for (std::size_t i = 0; i < emulation.size(); ++i) {
    text += fmt::format("{}joint{}: {{emulation: {}}}", i == 0 ? "" : ", ", i + 1, emulation[i]);
  }
  return text + "}}";
}

/// An arm that plays the sine goal, and what was seen of it at each millisecond.
class Sine {
 public:
  Sine(const std::vector<std::string>& emulation, double seconds)
      : joints_(emulation.size()),
        scenario(arm_of(static_cast<int>(joints_), drives(emulation))),
        playback(scenario, joints_) {
    if (!scenario.run_until_state(GroupState::Idle)) {
      ADD_FAILURE() << scenario.snapshot().fault;
      return;
    }
    const auto accepted = scenario.submit(sine_goal(static_cast<int>(joints_), seconds));
    if (!accepted) {
      ADD_FAILURE() << accepted.error().text;
      return;
    }
    goal_ = accepted.value().id;
    EXPECT_TRUE(scenario.run_until_state(GroupState::Moving));
    end_ = scenario.now() + host_duration(seconds - 0.05);
  }

  /// Runs for `seconds`, at most to shortly before the end of the goal; false from there on, or
  /// when the motion has ended.
  bool run(double seconds) {
    const HostTime until = std::min(end_, scenario.now() + host_duration(seconds));
    while (scenario.now() < until && scenario.state() == GroupState::Moving) {
      scenario.run(0.001);
      look();
    }
    return scenario.now() < end_ && scenario.state() == GroupState::Moving;
  }

  void finish() {
    const auto result = scenario.result_of(goal_, 20.0);
    EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
    for (const auto& joint : scenario.driver().report().joints) {
      EXPECT_LE(joint.worst_deviation, 1.0) << joint.joint;
      EXPECT_EQ(joint.underruns, 0u) << joint.joint;
    }
  }

  void inject(const std::string& target, const std::string& fault) {
    std::string reason;
    ASSERT_TRUE(scenario.driver().inject(target, fault, &reason, scenario.now())) << reason;
  }

 private:
  std::size_t joints_;

 public:
  Scenario scenario;
  Playback playback;
  int looks = 0;                ///< milliseconds looked at
  double worst_spread = 0.0;    ///< s, from drive to drive
  double worst_estimate = 0.0;  ///< s, what the driver thinks against what the drive plays

 private:
  // The desired state of a joint is its path where the driver thinks that the drive is: where the sine is
  // fast, its position tells that time.
  void look() {
    if (!playback.all_started()) return;
    ++looks;
    worst_spread = std::max(worst_spread, playback.spread(scenario.now()));
    ASSERT_TRUE(scenario.driver().query(scenario.now(), desired_));
    for (std::size_t i = 0; i < joints_; ++i) {
      const double sign = i % 2 == 0 ? 1.0 : -1.0;
      const double plays = sign * sine_position(playback.played(i, scenario.now()));
      worst_estimate = std::max(worst_estimate, std::abs(desired_[i].position - plays) / kSineSpeed);
    }
  }

  motion::GoalId goal_ = 0;
  HostTime end_{};
  std::vector<trajectory::State> desired_;
};

bool logged(const Scenario& scenario, const std::string& text) {
  return std::any_of(scenario.log().begin(), scenario.log().end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

// The counter-example, the same without discipline, is LongMotion.TenMinutesWithUnequalClocks: 120 ms apart.
TEST(ClockDiscipline, SixDrivesStayTogetherForTenMinutes) {
  Sine arm({"{clock_error_ppm: 100}", "{clock_error_ppm: -100}", "{clock_error_ppm: 50, tick_phase: 0.0003}",
            "{clock_error_ppm: -70}", "{clock_error_ppm: 0}", "{clock_error_ppm: 100, tick_phase: 0.0006}"},
           600.0);
  while (arm.run(60.0)) {
    for (const auto& joint : arm.scenario.snapshot().joints) EXPECT_EQ(joint.clock_error_ppm, 0.0);
  }
  EXPECT_GT(arm.looks, 599'900);
  EXPECT_LE(arm.worst_spread, 1e-3);
  EXPECT_LE(arm.worst_estimate, 1e-3);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(arm.playback.gained(i), 0.0, 5e-6) << i;
  RecordProperty("worst_spread_us", std::to_string(1e6 * arm.worst_spread));
  RecordProperty("worst_estimate_us", std::to_string(1e6 * arm.worst_estimate));
  RecordProperty("bus_load", std::to_string(arm.scenario.driver().report().peak_bus_load[0].second));
  arm.finish();
  for (const auto& joint : arm.scenario.driver().report().joints) EXPECT_EQ(joint.samples, 600001u);
}

// A time stamp lost costs the drift of a SYNC period, a SYNC lost (its time stamp then belongs to none) the
// same; seconds without any are ridden out on the crystals and made up afterwards.
TEST(ClockDiscipline, LostSyncsAndTimeStampsAreSurvived) {
  Sine arm({"{clock_error_ppm: 100}", "{clock_error_ppm: -100}"}, 60.0);
  const std::string faults[] = {"drop_id 0x080 1", fmt::format("drop_id {} 1", kTimeStampId),
                                fmt::format("drop_id {} 300", kTimeStampId), "drop_id 0x080 5"};
  int i = 0;
  while (arm.run(4.0)) arm.inject("can0", faults[i++ % 4]);
  EXPECT_GT(i, 10);
  EXPECT_LE(arm.worst_spread, 1.3e-3) << "up to 1 ms at the start, and 3 s of 200 ppm";
  EXPECT_LE(arm.worst_estimate, 1e-3);
  arm.finish();
}

// A drive that takes the time stamps but keeps its own time is found out by its FIFO, and then estimated like
// one without discipline; nothing it does is taken for a lost record.
TEST(ClockDiscipline, DriveThatDoesNotFollowIsEstimated) {
  Sine arm(
      {"{clock_error_ppm: 100, clock_discipline: false}", "{clock_error_ppm: -100, clock_discipline: false}"},
      300.0);
  while (arm.run(60.0)) {
  }
  EXPECT_NEAR(1e3 * arm.playback.gained(0), 30.0, 0.1);
  EXPECT_NEAR(1e3 * arm.playback.gained(1), -30.0, 0.1);
  EXPECT_LE(arm.worst_estimate, 0.012) << "a SYNC period and two samples";
  const auto joints = arm.scenario.snapshot().joints;
  EXPECT_NEAR(joints[0].clock_error_ppm, 100.0, 40.0);
  EXPECT_NEAR(joints[1].clock_error_ppm, -100.0, 40.0);
  arm.finish();
}

TEST(ClockDiscipline, DriveThatRefusesTimeStampsIsUsedAllTheSame) {
  Sine arm({"{clock_error_ppm: 100, time_stamp_pdo_mappable: false}", "{clock_error_ppm: -100}"}, 20.0);
  EXPECT_TRUE(logged(arm.scenario, "clock on its own, it takes no time stamps"));
  EXPECT_TRUE(logged(arm.scenario, "0x06040041")) << "in the words of the drive: not mappable";
  EXPECT_TRUE(logged(arm.scenario, "clock set by the host's (0x1013)"));
  while (arm.run(10.0)) {
  }
  EXPECT_NEAR(1e6 * arm.playback.gained(0), 2000.0, 20.0) << "100 ppm of 20 s";
  EXPECT_NEAR(1e6 * arm.playback.gained(1), 0.0, 5.0);
  arm.finish();
}

/// Time stamps on the wire within a second at rest.
int time_stamps_in_a_second(const std::string& bus) {
  Scenario scenario(arm_of(2, "{buses: {can0: " + bus + "}}"));
  EXPECT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  int count = 0;
  const auto count_stamps = [&count](const std::string&, const canopen::ReceivedFrame& received) {
    count += received.frame.id == kTimeStampId ? 1 : 0;
  };
  scenario.driver().set_wire_observer({count_stamps, {}});
  scenario.run(1.0);
  return count;
}

TEST(ClockDiscipline, TimeStampsAreOneFrameForAllDrivesAndAtMostAHundredASecond) {
  EXPECT_NEAR(time_stamps_in_a_second("{}"), 100, 1);
  EXPECT_NEAR(time_stamps_in_a_second("{sync_period: 0.02}"), 50, 1);
  EXPECT_NEAR(time_stamps_in_a_second("{sync_period: 0.004}"), 83, 1) << "each third SYNC";
  EXPECT_EQ(time_stamps_in_a_second("{clock_discipline: false}"), 0);
}

TEST(ClockDiscipline, IsSwitchedOffByTheConfiguration) {
  Scenario scenario(arm_of(1, "{buses: {can0: {clock_discipline: false}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  EXPECT_TRUE(logged(scenario, "clock on its own (clock_discipline is false)"));
  EXPECT_TRUE(std::isnan(scenario.snapshot().joints[0].clock_error_ppm)) << "nothing has told yet";
}

/// TIME, as a controller of the plant sends it.
constexpr const char* kTimeOfDay = "send 100#000000000000";

// An EPOS begins its clock anew with TIME, and the next time stamp of the host is then far away from it: so
// its clock runs as fast or slowly as the drive corrects it, and the motion with it.
TEST(ClockDiscipline, TimeOfDayOfAnotherNodeStopsTheMotionAndIsNamed) {
  Sine arm({"{clock_error_ppm: 100}", "{clock_error_ppm: -100}"}, 20.0);
  ASSERT_TRUE(arm.run(5.0));
  arm.inject("can0", kTimeOfDay);
  EXPECT_TRUE(arm.scenario.run_until([&] { return arm.scenario.state() != GroupState::Moving; }, 0.01));
  ASSERT_TRUE(arm.scenario.run_until_state(GroupState::Fault, 1.0));
  const std::string fault = arm.scenario.snapshot().fault;
  EXPECT_NE(fault.find("TIME, 100#000000000000"), std::string::npos) << fault;
  EXPECT_NE(fault.find("clock_discipline"), std::string::npos) << fault;
  EXPECT_LE(arm.worst_estimate, 1e-3);
}

// Drives on their own crystals do not care.
TEST(ClockDiscipline, TimeOfDayOfAnotherNodeIsOfNoMatterWithoutIt) {
  Scenario scenario(arm_of(2, "{buses: {can0: {clock_discipline: false}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(sine_goal(2, 5.0));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  std::string reason;
  for (int i = 0; i < 8; ++i) {
    scenario.run(0.5);
    ASSERT_TRUE(scenario.driver().inject("can0", kTimeOfDay, &reason, scenario.now())) << reason;
  }
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
}

}  // namespace
}  // namespace interpolated_motion::test
