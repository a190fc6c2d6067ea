#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/playback.h"
#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

double worst_deviation(const motion::MotionReport& report) {
  double worst = 0.0;
  for (const auto& joint : report.joints) worst = std::max(worst, joint.worst_deviation);
  return worst;
}

class CyclicGoals : public testing::TestWithParam<const char*> {};

TEST_P(CyclicGoals, AreFollowedAtEveryServoSample) {
  Scenario scenario(six_axis_cyclic());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  scenario.run(1.5);
  const auto accepted = scenario.submit(load_goal(goal_file(GetParam())));
  ASSERT_TRUE(accepted) << accepted.error().text;
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  const auto report = scenario.driver().report();
  for (const auto& joint : report.joints) {
    EXPECT_LE(joint.worst_deviation, 5.0) << joint.joint;
    EXPECT_LE(joint.final_deviation, 1.0) << joint.joint;
    EXPECT_EQ(joint.underruns, 0U) << joint.joint;
    EXPECT_GE(static_cast<double>(joint.samples), accepted.value().duration.count() * 1000.0) << joint.joint;
  }
  std::cout << GetParam() << ": worst deviation " << worst_deviation(report) << " counts, CAN load "
            << 100.0 * report.peak_bus_load.front().second << " %\n";
}

INSTANTIATE_TEST_SUITE_P(Planned, CyclicGoals,
                         testing::Values("six_axis_toppra_100ms_pv.yaml", "six_axis_toppra_100ms_pva.yaml",
                                         "six_axis_toppra_20ms_pva.yaml"),
                         [](const testing::TestParamInfo<const char*>& file) {
                           const std::string name = file.param;
                           return name.substr(0, name.find('.'));
                         });

// A drive that takes its setpoints at the wrong instant is off by its speed times the error in time, whatever
// the driver believes: here the speed is known from the goal, and the time is that of the world.
class TrueTime {
 public:
  TrueTime(Scenario& scenario, std::size_t joints) : demands_(joints) {
    scenario.driver().set_sample_observer([this](std::size_t joint, const hardware::DemandSample& sample) {
      demands_[joint][sample.time] = sample.demand;
    });
  }

  /// Demand of the drive at `when`, counts, between its samples on a line.
  double demand(std::size_t joint, HostTime when) const {
    const auto after = demands_[joint].lower_bound(when);
    const auto before = std::prev(after);
    const double share = seconds(when - before->first) / seconds(after->first - before->first);
    return before->second + share * (after->second - before->second);
  }

 private:
  std::vector<std::map<HostTime, double>> demands_;
};

/// From the drive that is least to the one that is most advanced along the sine, s, where all are fast.
double spread_in_time(const TrueTime& drives, const std::vector<double>& counts_per_radian, HostTime when) {
  double least = 1e9;
  double most = -1e9;
  for (std::size_t i = 0; i < counts_per_radian.size(); ++i) {
    const double position = std::abs(drives.demand(i, when)) / counts_per_radian[i];
    // sine_position(t) = 0.2 (1 - cos(pi t)), solved for t in the first half period.
    const double t = std::acos(1.0 - position / 0.2) / kPi;
    least = std::min(least, t);
    most = std::max(most, t);
  }
  return most - least;
}

const double kEposCounts = 100.0 * 2000.0 / (2.0 * kPi);
const double kSilverlodeCounts = 50.0 * 4000.0 / (2.0 * kPi);

TEST(CyclicGroup, DrivesWithClocksOfTheirOwnPlayAsOne) {
  Scenario scenario(
      six_axis_cyclic("{drives: {joint1: {emulation: {clock_error_ppm: 100, tick_phase: 0.0002}}, "
                      "joint4: {emulation: {clock_error_ppm: -100, tick_phase: 0.0007}}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  TrueTime drives(scenario, 6);
  const auto accepted = scenario.submit(sine_goal(6, 20.0));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  scenario.run(0.5);
  const HostTime early = scenario.now() - std::chrono::milliseconds(20);
  EXPECT_LE(spread_in_time(drives, std::vector<double>(6, kEposCounts), early), 50e-6);
  scenario.run(18.0);
  const HostTime late = scenario.now() - std::chrono::milliseconds(20);
  EXPECT_LE(spread_in_time(drives, std::vector<double>(6, kEposCounts), late), 50e-6);
  EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
}

// EPOS drives begin at a sample of their own behind SYNC, SilverLode drives at a command on a slow line.
TEST(CyclicGroup, StartsAndMovesTogetherWithTheOtherKinds) {
  Scenario scenario(six_axis_of_all_kinds());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  TrueTime drives(scenario, 6);
  const auto accepted = scenario.submit(sine_goal(6, 4.0));
  ASSERT_TRUE(accepted) << accepted.error().text;
  ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
  const auto third = [&] { return scenario.snapshot().goal_time >= GoalTime{0.4}; };
  ASSERT_TRUE(scenario.run_until(third, 5.0));
  scenario.run(0.02);
  const std::vector<double> counts{kEposCounts, kEposCounts,       kEposCounts,
                                   kEposCounts, kSilverlodeCounts, kSilverlodeCounts};
  const double spread = spread_in_time(drives, counts, scenario.now() - std::chrono::milliseconds(5));
  EXPECT_LE(spread, 2e-3);
  const auto result = scenario.result_of(accepted.value().id);
  EXPECT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  for (const auto& joint : scenario.driver().report().joints)
    EXPECT_LE(joint.worst_deviation, 5.0) << joint.joint;
}

TEST(CyclicGroup, CanLoadBesideThePvtRunOfTheSameGoal) {
  const auto peak_load = [](const YAML::Node& parameters) {
    Scenario scenario(parameters);
    EXPECT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
    scenario.run(1.5);  // the load is that of the last second: without the bring-up
    const auto accepted = scenario.submit(load_goal(goal_file("six_axis_toppra_20ms_pva.yaml")));
    EXPECT_TRUE(accepted);
    EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded);
    return scenario.driver().report().peak_bus_load.front().second;
  };
  const double cyclic = peak_load(six_axis_cyclic());
  const double pvt = peak_load(six_axis());
  std::cout << "peak CAN load: cyclic at 10 ms " << 100.0 * cyclic << " %, PVT " << 100.0 * pvt << " %\n";
  // Each 10 ms: SYNC, and for six drives frames of 8, 7 and 8 bytes, each at least as long as without
  // stuffing.
  const double least = (47 + 6 * (3 * 47 + 8 * (8 + 7 + 8))) / 10e3;
  EXPECT_GE(cyclic, least);
  EXPECT_LE(cyclic, 1.25 * least);
}

TEST(CyclicGroup, PathTooFastForThePeriodIsRefusedWithTheReason) {
  YAML::Node parameters = six_axis_cyclic("{buses: {can0: {sync_period: 0.02}}}");
  for (auto drive : parameters["drives"]) drive.second["deviation_bound"] = 1.5;
  Scenario scenario(parameters);
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  const auto refused = scenario.submit(load_goal(goal_file("six_axis_toppra_100ms_pva.yaml")));
  ASSERT_FALSE(refused);
  const std::string& text = refused.error().text;
  for (const char* part : {"Joint 'joint", "20 ms", "deviation_bound", "1.5", "sync_period"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

// From a little beside the first point the lead-in lasts no longer than a period: its target positions are a
// step, and the drive goes beyond the limit of acceleration between them.
TEST(CyclicGroup, ShortLeadInIsMadeGentler) {
  for (const double beside : {0.0005, 0.001, 0.004}) {
    Scenario scenario(six_axis_cyclic("{buses: {can0: {sync_period: 0.02}}}"));
    ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
    std::vector<double> first = scenario.positions();
    first[0] += beside;
    std::vector<double> last = first;
    last[0] += 0.5;
    const auto accepted = scenario.submit(make_goal({0.0, 2.0}, {first, last}));
    ASSERT_TRUE(accepted) << beside << ": " << accepted.error().text;
    EXPECT_EQ(scenario.result_of(accepted.value().id).outcome, GoalOutcome::Succeeded) << beside;
    EXPECT_NEAR(scenario.positions()[0], last[0], 1e-3) << beside;
  }
}

TEST(CyclicGroup, SyncIsWatched) {
  Scenario scenario(six_axis_cyclic());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle)) << scenario.snapshot().fault;
  scenario.run(3.0);
  const auto bus = scenario.snapshot().buses.front();
  // SYNC has 44 bits and at most 8 of stuffing at 1 Mbit/s; it may find the bus taken by one frame of 135.
  EXPECT_GE(bus.sync_delay, 44e-6);
  EXPECT_LE(bus.sync_delay, 60e-6);
  EXPECT_LE(bus.sync_jitter, 135e-6);
  EXPECT_EQ(bus.syncs_skipped, 0U);
}

}  // namespace
}  // namespace interpolated_motion::test
