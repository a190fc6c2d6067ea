#include <algorithm>
#include <cstdio>
#include <functional>

#include <gtest/gtest.h>

#include "hardware/playback.h"
#include "hardware/scenario.h"

// How long the host may be away without any consequence but that it was away: the drives' buffers bridge it,
// at rest nothing needs it. The table of docs/buses.md:
//
//     build/hardware_tests --gtest_filter='*Stalls.*' | grep '^|'
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

YAML::Node silverlode_with_queue_of(int depth) {
  YAML::Node arm = six_axis_silverlode();
  for (int i = 1; i <= 6; ++i) arm["drives"]["joint" + std::to_string(i)]["emulation"]["queue_depth"] = depth;
  return arm;
}

struct Arm {
  const char* name;
  std::function<YAML::Node()> configuration;
  double bound;    ///< counts
  double horizon;  ///< s, commit_horizon
};

const Arm kArms[] = {
    {"EPOS2, commit_horizon 2", [] { return six_axis("{commit_horizon: 2}"); }, 1.0, 2.0},
    {"EPOS2, commit_horizon 6", [] { return six_axis("{commit_horizon: 6}"); }, 1.0, 6.0},
    {"EPOS2, commit_horizon 0.5", [] { return six_axis("{commit_horizon: 0.5}"); }, 1.0, 0.5},
    {"SilverLode, 8 deep", [] { return silverlode_with_queue_of(8); }, 2.0, 0.5},
    {"SilverLode, 4 deep", [] { return silverlode_with_queue_of(4); }, 2.0, 0.5},
    {"EPOS2 and SilverLode", [] { return six_axis_mixed(); }, 2.0, 0.5},
    {"cyclic", [] { return six_axis_cyclic(); }, 5.0, 2.0},
};

/// The world goes on without the host; then the host is as late as it was away.
void stall(Scenario& scenario, double duration) {
  scenario.driver().stall(scenario.now() + host_duration(duration));
  scenario.run(duration);
}

/// What the drives have for certain to play without their host, s.
double buffered(Scenario& scenario) {
  double least = 1e9;
  for (const auto& joint : scenario.snapshot().joints) least = std::min(least, joint.fill_time);
  return least;
}

bool brought_up(Scenario& scenario) { return scenario.run_until_state(GroupState::Idle); }

/// Whether a goal succeeds within `bound` though the host is away for `duration` in the middle of it.
bool rides_out(const Arm& arm, double duration) {
  Scenario scenario(arm.configuration());
  if (!brought_up(scenario)) return false;
  const auto accepted = scenario.submit(sine_goal(6, 12.0));
  if (!accepted || !scenario.run_until_state(GroupState::Moving)) return false;
  scenario.run(3.0);
  stall(scenario, duration);
  if (scenario.result_of(accepted.value().id).outcome != GoalOutcome::Succeeded) return false;
  const auto report = scenario.driver().report();
  return std::all_of(report.joints.begin(), report.joints.end(),
                     [&arm](const auto& joint) { return joint.worst_deviation <= arm.bound; });
}

double least_buffered(const Arm& arm) {
  Scenario scenario(arm.configuration());
  if (!brought_up(scenario) || !scenario.submit(sine_goal(6, 12.0))) return 0.0;
  scenario.run_until_state(GroupState::Moving);
  scenario.run(3.0);
  return buffered(scenario);
}

class Stalls : public testing::TestWithParam<Arm> {};

// By halving between what is ridden out and what is not.
TEST_P(Stalls, AreRiddenOutInMotionForAsLongAsTheBufferLasts) {
  double ridden = 0.0;
  double not_ridden = 8.0;
  while (not_ridden - ridden > 0.05) {
    const double middle = (ridden + not_ridden) / 2.0;
    (rides_out(GetParam(), middle) ? ridden : not_ridden) = middle;
  }
  const double held = least_buffered(GetParam());
  std::printf("| %s | %.2f | %.2f |\n", GetParam().name, held, ridden);
  EXPECT_GE(ridden, std::min(held, GetParam().horizon) - 0.1);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Stalls, testing::ValuesIn(kArms),
                         [](const auto& arm) { return "Arm" + std::to_string(arm.index); });

TEST(StallOfEpos, OfCommitHorizonLessATenthOfASecondIsRiddenOut) {
  EXPECT_TRUE(rides_out(kArms[0], 1.9));
  EXPECT_TRUE(rides_out(kArms[1], 5.9));
  EXPECT_TRUE(rides_out(kArms[2], 0.4));
}

// Enabled and at rest, before any motion and after one, and after one that was stopped.
void expect_rest_without_host(const YAML::Node& arm) {
  Scenario scenario(arm);
  ASSERT_TRUE(brought_up(scenario)) << scenario.snapshot().fault;
  stall(scenario, 20.0);
  scenario.run(0.5);
  ASSERT_EQ(scenario.state(), GroupState::Idle) << scenario.snapshot().fault;
  const auto moved = scenario.submit(sine_goal(6, 2.0));
  ASSERT_TRUE(moved) << moved.error().text;
  const auto result = scenario.result_of(moved.value().id);
  ASSERT_EQ(result.outcome, GoalOutcome::Succeeded) << result.text;
  stall(scenario, 20.0);
  scenario.run(0.5);
  ASSERT_EQ(scenario.state(), GroupState::Idle) << scenario.snapshot().fault;
  const auto stopped = scenario.submit(sine_goal(6, 4.0));
  ASSERT_TRUE(stopped) << stopped.error().text;
  scenario.run(2.0);
  scenario.driver().cancel(stopped.value().id, scenario.now());
  ASSERT_EQ(scenario.result_of(stopped.value().id).outcome, GoalOutcome::Preempted);
  stall(scenario, 20.0);
  scenario.run(0.5);
  EXPECT_EQ(scenario.state(), GroupState::Idle) << scenario.snapshot().fault;
}

TEST(StallAtRest, OfAnyLengthCostsAnEposNothing) { expect_rest_without_host(six_axis()); }
TEST(StallAtRest, OfAnyLengthCostsASilverLodeNothing) { expect_rest_without_host(six_axis_silverlode()); }
TEST(StallAtRest, OfAnyLengthCostsBothOnOneArmNothing) { expect_rest_without_host(six_axis_mixed()); }

// Switched off, and after a fault in motion that has been reset.
TEST(StallAtRest, OfAnyLengthCostsADisabledEposNothing) {
  Scenario scenario(six_axis("{enable_on_start: false}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Disabled)) << scenario.snapshot().fault;
  stall(scenario, 20.0);
  scenario.run(0.5);
  EXPECT_EQ(scenario.state(), GroupState::Disabled) << scenario.snapshot().fault;
}

TEST(StallAtRest, AfterAFaultInMotionCostsNothing) {
  Scenario scenario(six_axis());
  ASSERT_TRUE(brought_up(scenario)) << scenario.snapshot().fault;
  const auto accepted = scenario.submit(sine_goal(6, 4.0));
  ASSERT_TRUE(accepted) << accepted.error().text;
  scenario.run(2.0);
  std::string reason;
  ASSERT_TRUE(scenario.driver().inject("joint2", "emcy 0x2310", &reason, scenario.now())) << reason;
  scenario.result_of(accepted.value().id);
  scenario.run(1.0);
  scenario.driver().reset_faults(scenario.now());
  ASSERT_TRUE(scenario.run_until_state(GroupState::Disabled)) << scenario.snapshot().fault;
  stall(scenario, 20.0);
  scenario.run(0.5);
  EXPECT_EQ(scenario.state(), GroupState::Disabled) << scenario.snapshot().fault;
}

// Who wants a drive at rest to notice that its host is gone says so.
TEST(StallAtRest, IsNoticedByAnEposWhereThatIsAskedFor) {
  Scenario scenario(six_axis("{buses: {can0: {watch_at_rest: 1.0}}}"));
  ASSERT_TRUE(brought_up(scenario)) << scenario.snapshot().fault;
  stall(scenario, 0.8);
  scenario.run(0.5);
  ASSERT_EQ(scenario.state(), GroupState::Idle) << scenario.snapshot().fault;
  stall(scenario, 1.2);
  scenario.run(0.5);
  EXPECT_EQ(scenario.state(), GroupState::Fault);
  EXPECT_NE(scenario.snapshot().fault.find("0x8130"), std::string::npos) << scenario.snapshot().fault;
}

// A host that never comes back: the longest way that an EPOS goes on is what its FIFO holds.
TEST(DeadHost, AnEposGoesOnForCommitHorizonAtMost) {
  for (const double horizon : {0.5, 2.0}) {
    Scenario scenario(six_axis("{commit_horizon: " + std::to_string(horizon) + "}"));
    ASSERT_TRUE(brought_up(scenario)) << scenario.snapshot().fault;
    ASSERT_TRUE(scenario.submit(sine_goal(6, 20.0)));
    ASSERT_TRUE(scenario.run_until_state(GroupState::Moving));
    scenario.run(3.0);
    stall(scenario, horizon + 0.3);  // a record of 0.25 s may be on top, and a ramp of 0.03 s
    const auto rest = *scenario.driver().emulated_position(0);
    stall(scenario, 20.0);
    EXPECT_EQ(*scenario.driver().emulated_position(0), rest) << horizon;
  }
}

}  // namespace
}  // namespace interpolated_motion::test
