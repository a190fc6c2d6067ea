#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hardware/accepted_is_held.h"

// What a serial line is asked to carry is accepted and held, or refused: at every rate, with any number of
// drives on the line, whatever the depth of their queues, however late they answer.
//
//     IMD_PROPERTY_CASES=270 build/hardware_tests --gtest_filter='*SerialLine.Holds*'    # all 1350
namespace interpolated_motion::test {
namespace {

constexpr int kDrives[] = {1, 2, 3, 4, 6};
constexpr double kTurnaround[] = {0.002, 0.005};  // s, of the drives; the configuration says 0.002
constexpr double kMaxLoad[] = {0.6, 0.8, 0.95};
constexpr const char* kQueues[] = {"emulation: {queue_depth: 4}", "emulation: {queue_depth: 8}",
                                   "queue: register, emulation: {queue_depth: 4}"};
constexpr const char* kQueueNames[] = {"4 deep", "8 deep", "registers"};
constexpr int kCombinations = 5 * 2 * 3 * 3 * 3;

struct Combination {
  int baud;
  int drives;
  double turnaround;
  double max_load;
  std::size_t queue;
  SweepGoal goal;

  std::string text() const {
    return fmt::format("{} baud, {} drives, {} s, max_load {}, {}, {}", baud, drives, turnaround, max_load,
                       kQueueNames[queue], name_of(goal));
  }
};

template <class Value, std::size_t kSize>
Value pick(const Value (&values)[kSize], int& number) {
  const Value value = values[static_cast<std::size_t>(number) % kSize];
  number /= static_cast<int>(kSize);
  return value;
}

Combination combination(int baud, int number) {
  const SweepGoal goal = pick(kSweepGoals, number);
  const int drives = pick(kDrives, number);
  const double max_load = pick(kMaxLoad, number);
  constexpr std::size_t kNumbers[] = {0, 1, 2};
  const std::size_t queue = pick(kNumbers, number);
  return {baud, drives, pick(kTurnaround, number), max_load, queue, goal};
}

/// Crystals are as they are; every other arm has firmware that reads one register at a time.
YAML::Node arm_of(const Combination& c) {
  YAML::Node arm = YAML::Load(
      fmt::format("{{buses: {{line0: {{type: silverlode, baud: {}, max_load: {}}}}}}}", c.baud, c.max_load));
  for (int i = 0; i < c.drives; ++i) {
    const std::string joint = fmt::format("joint{}", i + 1);
    arm["joints"].push_back(joint);
    YAML::Node drive = YAML::Load(
        fmt::format("{{bus: line0, type: silverlode_ims, address: {}, counts_per_revolution: 4000, "
                    "gear_ratio: 50, limits: {{max_acceleration: 20}}, {}}}",
                    16 + i, kQueues[c.queue]));
    drive["emulation"]["turnaround"] = c.turnaround;
    drive["emulation"]["clock_error_ppm"] = i % 2 == 0 ? 60 : -40;
    drive["emulation"]["multi_register_read"] = c.drives % 2 == 1;
    arm["drives"][joint] = drive;
  }
  return arm;
}

class SerialLine : public testing::TestWithParam<int> {};

TEST_P(SerialLine, HoldsWhatIsAccepted) {
  SweepTally tally(fmt::format("{} baud", GetParam()));
  for (const int number : sweep_sample(kCombinations, 6)) {
    const Combination c = combination(GetParam(), number);
    tally.add(c.text(), verdict_of(arm_of(c), sweep_goal(c.goal, c.drives), 2.0));
  }
  tally.print();
}

INSTANTIATE_TEST_SUITE_P(Baud, SerialLine, testing::Values(9600, 19200, 38400, 57600, 115200));

}  // namespace
}  // namespace interpolated_motion::test
