#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/script_generator.h"
#include "simulation/simulation.h"

namespace interpolated_motion::simulation {
namespace {

constexpr char kArm[] =
    "configuration {joints: [joint1], buses: {can0: {type: canopen}}, drives: {joint1: {bus: can0, type: "
    "epos_ipm, "
    "node_id: 1, counts_per_revolution: 2000, gear_ratio: 100, limits: {max_acceleration: 20}}}}\n";

std::vector<std::string> told(const std::string& events, Outcome* outcome) {
  std::vector<std::string> lines;
  *outcome = simulate(parse_script(kArm + events),
                      [&lines](double, const std::string& line) { lines.push_back(line); });
  return lines;
}

bool contains(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines)
    if (line.find(part) != std::string::npos) return true;
  return false;
}

TEST(Simulated, SameSeedSameTrace) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Script script = random_script(seed);
    const Outcome first = simulate(script);
    const Outcome second = simulate(script);
    EXPECT_EQ(first.trace, second.trace) << "seed " << seed;
    EXPECT_EQ(first.seconds, second.seconds) << "seed " << seed;
  }
  EXPECT_NE(simulate(random_script(1)).trace, simulate(random_script(2)).trace);
}

TEST(Simulated, AGoalIsToldFromOrderToResult) {
  Outcome outcome;
  const auto lines = told("at 0.5 goal points=3 shape=1 effort=0.5 reach=0.5 noise=4\n", &outcome);
  EXPECT_FALSE(outcome.violation) << outcome.violation->sentence;
  EXPECT_EQ(outcome.goals_succeeded, 1U);
  EXPECT_TRUE(contains(lines, "> at 0.5 goal"));
  EXPECT_TRUE(contains(lines, "group: preparing -> moving"));
  EXPECT_TRUE(contains(lines, "goal 1 succeeded"));
}

TEST(Simulated, AFaultIsToldWithItsCauseAndTheGroupStops) {
  Outcome outcome;
  const auto lines = told(
      "at 0.5 goal points=3 shape=1 effort=0.2 reach=1 noise=4\n"
      "at 0.8 inject joint1 emcy 0x2310\n"
      "at 2 reset\nat 3 enable\n",
      &outcome);
  EXPECT_FALSE(outcome.violation) << outcome.violation->sentence;
  EXPECT_TRUE(contains(lines, "goal 1 aborted: "));
  EXPECT_TRUE(contains(lines, "-> fault: "));
  EXPECT_TRUE(contains(lines, "request 2 done: "));
}

TEST(Simulated, ADeadHostLeavesTheArmAtRest) {
  Outcome outcome;
  const auto lines = told("at 0.5 goal points=3 shape=1 effort=0.2 reach=2 noise=4\nat 0.8 die\n", &outcome);
  EXPECT_FALSE(outcome.violation) << outcome.violation->sentence;
  EXPECT_FALSE(contains(lines, "goal 1 succeeded"));
}

TEST(Simulated, AConfigurationThatIsRefusedIsAViolation) {
  const Outcome outcome =
      simulate(parse_script("configuration {joints: [joint1], buses: {}, drives: {joint1: {bus: x, "
                            "counts_per_revolution: 1, node_id: 1}}}\n"));
  ASSERT_TRUE(outcome.violation);
  EXPECT_EQ(outcome.violation->invariant, "no exception");
}

// The number of seeds can be set by IMD_SIMULATION_SEEDS; scripts/simulate is made for more of them.
TEST(Simulated, FirstSeedsHold) {
  const char* text = std::getenv("IMD_SIMULATION_SEEDS");
  const int seeds = text == nullptr ? 30 : std::atoi(text);
  for (int seed = 1; seed <= seeds; ++seed) {
    const Script script = random_script(static_cast<std::uint64_t>(seed));
    const Outcome outcome = simulate(script);
    if (!outcome.violation) continue;
    ADD_FAILURE() << "seed " << seed << ": " << outcome.violation->invariant << ": at "
                  << outcome.violation->time << " s: " << outcome.violation->sentence;
  }
}

}  // namespace
}  // namespace interpolated_motion::simulation
