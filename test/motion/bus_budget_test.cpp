#include "interpolated_motion_driver/motion/bus_budget.h"

#include <gtest/gtest.h>

namespace interpolated_motion::motion {
namespace {

/// One axis that needs a record every `period` s for `duration` s and may have `ahead` of them.
BusDemand axis(double period, double duration, int ahead, double bus_time) {
  BusDemand demand;
  demand.record_bus_time = bus_time;
  const int count = static_cast<int>(duration / period);
  for (int i = 0; i < count; ++i) {
    demand.slots.push_back({GoalTime{period * std::max(0, i - ahead)}, GoalTime{period * i}});
  }
  return demand;
}

TEST(BusBudget, TakesWhatFitsOnTheLongRun) {
  // 6 axes, one record each 10 ms: 600 a second, of 0.2 ms each: 12 % of the time.
  EXPECT_FALSE(check_bus_budget(std::vector<BusDemand>(6, axis(0.010, 20.0, 60, 0.0002)), GoalTime{0.0}));
}

TEST(BusBudget, RefusesWhatDoesNotFitOnTheLongRun) {
  // 6 axes, one record each ms, 0.2 ms each: 120 %. The FIFOs hide it at first.
  const auto missed =
      check_bus_budget(std::vector<BusDemand>(6, axis(0.001, 20.0, 60, 0.0002)), GoalTime{0.0});
  ASSERT_TRUE(missed);
  EXPECT_GT(missed->time.count(), 0.06);
  EXPECT_NEAR(missed->needed, 6000.0 * std::min(1.0, missed->time.count() - 0.06), 600.0);
}

TEST(BusBudget, FifosCarryAPeakTheBusCannot) {
  // 40 records in 40 ms, then nothing: all loaded before the start.
  EXPECT_FALSE(check_bus_budget({axis(0.001, 0.040, 60, 0.05)}, GoalTime{0.0}));
}

TEST(BusBudget, TimeBeforeTheStartIsFree) {
  BusDemand demand;
  demand.record_bus_time = 1.0;
  demand.slots = {{GoalTime{-1.0}, GoalTime{-1.0}}, {GoalTime{-1.0}, GoalTime{-0.9}}};
  EXPECT_FALSE(check_bus_budget({demand}, GoalTime{-1.0}));
}

}  // namespace
}  // namespace interpolated_motion::motion
