#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/script.h"
#include "simulation/simulation.h"

// The host is late with SYNC by up to 4 ms, once or often: nothing but target positions is missing, and all
// invariants hold.
namespace interpolated_motion::simulation {
namespace {

std::string cyclic_arm(double period) {
  return fmt::format(
      "configuration {{joints: [joint1], buses: {{can0: {{type: canopen, sync_period: {}}}}}, drives: "
      "{{joint1: {{bus: can0, type: cyclic, node_id: 1, counts_per_revolution: 2000, gear_ratio: 100, "
      "limits: "
      "{{max_acceleration: 20}}}}}}}}\n",
      period);
}

/// EPOS and cyclic drive on one bus, whose start signal is SYNC, and a SilverLode drive that waits for them.
constexpr char kArmOfAllKinds[] =
    "configuration {joints: [joint1, joint2, joint3], buses: {can0: {type: canopen}, line0: {type: "
    "silverlode}}, drives: {"
    "joint1: {bus: can0, type: cyclic, node_id: 1, counts_per_revolution: 2000, gear_ratio: 100, limits: "
    "{max_acceleration: 20}}, "
    "joint2: {bus: can0, type: epos_ipm, node_id: 2, counts_per_revolution: 2000, gear_ratio: 100, limits: "
    "{max_acceleration: 20}}, "
    "joint3: {bus: line0, type: silverlode_ims, address: 16, counts_per_revolution: 4000, gear_ratio: 50, "
    "limits: {max_acceleration: 20}}}}\n";

std::string goal(double effort) {
  return fmt::format("at 0.5 goal points=5 shape=2 effort={} reach=1 noise=4\n", effort);
}

std::string late_at(double time) { return fmt::format("at {:.4f} late for=0.004\n", time); }

void expect_success(const std::string& script, double late) {
  const Outcome outcome = simulate(parse_script(script));
  if (outcome.violation) {
    ADD_FAILURE() << late << " s: " << outcome.violation->invariant << ": at " << outcome.violation->time
                  << " s: " << outcome.violation->sentence;
  }
  EXPECT_EQ(outcome.goals_succeeded, 1U) << late;
}

class LateSync : public testing::TestWithParam<double> {};

TEST_P(LateSync, LeavesACyclicDriveWithinItsLimits) {
  constexpr double kEffort = 0.5;  // of more, a target position each 20 ms does not tell enough
  for (double late = 0.505; late < 1.6; late += 0.0437)
    expect_success(cyclic_arm(GetParam()) + goal(kEffort) + late_at(late), late);
}

INSTANTIATE_TEST_SUITE_P(Periods, LateSync, testing::Values(0.005, 0.01, 0.02));

TEST(LateSyncOfAllKinds, DoesNotKeepTheDrivesFromBeginningTogether) {
  for (double late = 0.503; late < 0.9; late += 0.0237)
    expect_success(kArmOfAllKinds + goal(0.5) + late_at(late), late);
}

// As seldom as a drive is back on its path meanwhile.
TEST(LateSyncOfAllKinds, MayComeAgainAndAgain) {
  std::string script = kArmOfAllKinds + goal(0.5);
  for (double late = 0.52; late < 2.0; late += 0.067) script += late_at(late);
  expect_success(script, 0.0);
}

}  // namespace
}  // namespace interpolated_motion::simulation
