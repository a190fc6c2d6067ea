#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/accepted_is_held.h"

// What a CAN bus is asked to carry is accepted and held, or refused, as configuration or as goal.
//
//     IMD_PROPERTY_CASES=90 build/hardware_tests --gtest_filter='*CanBus.Holds*'    # all 360
namespace interpolated_motion::test {
namespace {

constexpr int kDrives[] = {1, 2, 3, 4, 6};
constexpr double kSyncPeriod[] = {0.01, 0.04};
constexpr double kMaxLoad[] = {0.3, 0.6, 0.9};
constexpr int kCombinations = 3 * 5 * 2 * 3;

class CanBus : public testing::TestWithParam<int> {};

TEST_P(CanBus, HoldsWhatIsAccepted) {
  SweepTally tally(fmt::format("{} bit/s", GetParam()));
  for (int number : sweep_sample(kCombinations, 5)) {
    const SweepGoal goal = kSweepGoals[number % 3];
    const int drives = kDrives[(number /= 3) % 5];
    const double sync_period = kSyncPeriod[(number /= 5) % 2];
    const double max_load = kMaxLoad[(number / 2) % 3];
    const std::string bus = fmt::format("{{buses: {{can0: {{bitrate: {}, sync_period: {}, max_load: {}}}}}}}",
                                        GetParam(), sync_period, max_load);
    const std::string text = fmt::format("{} drives, sync_period {}, max_load {}, {}", drives, sync_period,
                                         max_load, name_of(goal));
    Verdict verdict;
    try {
      verdict = verdict_of(arm_of(drives, bus), sweep_goal(goal, drives), 1.0);
    } catch (const std::invalid_argument& error) {
      verdict.text = error.what();
    }
    tally.add(text, verdict);
  }
  tally.print();
}

INSTANTIATE_TEST_SUITE_P(Bitrate, CanBus, testing::Values(125000, 250000, 500000, 1000000));

}  // namespace
}  // namespace interpolated_motion::test
