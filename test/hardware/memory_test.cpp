#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

/// Resident memory of this process, MiB.
double resident_mib() {
  std::ifstream statm("/proc/self/statm");
  long total = 0;
  long resident = 0;
  statm >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

/// Plays `count` short goals, there and back.
void play_goals(Scenario& scenario, int count) {
  for (int i = 0; i < count; ++i) {
    const std::vector<double> target(6, i % 2 == 0 ? 0.01 : 0.0);
    const auto accepted = scenario.submit(make_goal({0.1}, {target}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    ASSERT_EQ(scenario.result_of(accepted.value().id).outcome, motion::GoalOutcome::Succeeded);
  }
}

class Memory : public testing::TestWithParam<const char*> {};

TEST_P(Memory, DoesNotGrowOverAThousandGoals) {
  Scenario scenario(std::string(GetParam()) == "epos" ? six_axis() : six_axis_mixed());
  ASSERT_TRUE(scenario.run_until_state(motion::GroupState::Idle)) << scenario.snapshot().fault;
  play_goals(scenario, 200);
  const double before = resident_mib();
  play_goals(scenario, 800);
  EXPECT_LT(resident_mib(), before + 1.0);
}

INSTANTIATE_TEST_SUITE_P(Arms, Memory, testing::Values("epos", "mixed"));

}  // namespace
}  // namespace interpolated_motion::test
