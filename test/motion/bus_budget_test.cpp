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

/// One record of an axis.
BusDemand record(double release, double deadline, double bus_time) {
  return {{{GoalTime{release}, GoalTime{deadline}}}, bus_time};
}

// Both are waiting when the bus becomes free at 1.1 s. In the order of their release, or of the axes, the one
// that is due at 1.5 s would end at 2.0 s.
TEST(BusBudget, OfThoseThatWaitTheOneDueFirstIsSent) {
  const std::vector<BusDemand> demands{record(0.1, 9.0, 1.0), record(0.2, 9.0, 0.5), record(0.3, 1.5, 0.4)};
  EXPECT_FALSE(check_bus_budget(demands, GoalTime{0.0}));
}

// A record on the bus is not interrupted, and none is held back for one that is yet to come: whoever held the
// first back for 0.3 s could carry both.
TEST(BusBudget, ARecordOnTheBusIsNotInterrupted) {
  const auto missed = check_bus_budget({record(0.1, 9.0, 1.0), record(0.2, 0.5, 0.2)}, GoalTime{0.0});
  ASSERT_TRUE(missed);
  EXPECT_NEAR(missed->time.count(), 0.5, 1e-12);
  EXPECT_NEAR(missed->late.count(), 0.1 + 1.0 + 0.2 - 0.5, 1e-12);
}

// 1.2 s of bus between 0.1 s and 1.0 s: no order helps. What is said: when, by how much, how many.
TEST(BusBudget, WhatNoOrderCarriesIsRefusedWithItsFigures) {
  const std::vector<BusDemand> demands(3, record(0.1, 1.0, 0.4));
  const auto missed = check_bus_budget(demands, GoalTime{0.0});
  ASSERT_TRUE(missed);
  EXPECT_NEAR(missed->time.count(), 1.0, 1e-12);
  EXPECT_NEAR(missed->late.count(), 0.1 + 3 * 0.4 - 1.0, 1e-12);
  EXPECT_EQ(missed->needed, 3.0);
  EXPECT_FALSE(check_bus_budget({demands[0], demands[1]}, GoalTime{0.0})) << "two of them fit";
}

// Records of a second and more before are not counted as needed in the second before.
TEST(BusBudget, NeededAreThoseOfTheSecondBefore) {
  std::vector<BusDemand> demands{record(0.1, 0.9, 0.1)};
  for (int i = 0; i < 4; ++i) demands.push_back(record(2.0, 2.5, 0.15));
  const auto missed = check_bus_budget(demands, GoalTime{0.0});
  ASSERT_TRUE(missed);
  EXPECT_NEAR(missed->late.count(), 2.0 + 4 * 0.15 - 2.5, 1e-12);
  EXPECT_EQ(missed->needed, 4.0);
}

// Each axis has its own bus time: a register-based queue takes five times as long as the other.
TEST(BusBudget, RecordsOfDifferentAxesTakeDifferentTimes) {
  EXPECT_FALSE(check_bus_budget({axis(0.1, 10.0, 1, 0.05), axis(0.1, 10.0, 1, 0.01)}, GoalTime{0.0}));
  EXPECT_TRUE(check_bus_budget({axis(0.1, 10.0, 1, 0.05), axis(0.1, 10.0, 1, 0.06)}, GoalTime{0.0}));
}

/// Of one axis that is asked every `period` s for `time` s, its records taking `record` s of the bus.
BusDemand watched(BusDemand demand, double record, double time, double period) {
  demand.watch = {record, time, time, period, GoalTime{0.0}};
  return demand;
}

// Records fill 80 % of the bus, as they may; questions take another 25 %.
TEST(BusBudget, QuestionsToTheDrivesAreCarriedToo) {
  const BusDemand records = axis(0.1, 20.0, 4, 0.08);
  EXPECT_FALSE(check_bus_budget({records}, GoalTime{0.0}));
  EXPECT_FALSE(check_bus_budget({watched(records, 0.08, 0.03, 0.3)}, GoalTime{0.0}));
  const auto missed = check_bus_budget({watched(records, 0.08, 0.075, 0.3)}, GoalTime{0.0});
  ASSERT_TRUE(missed);
  EXPECT_NEAR(missed->looks, 0.25, 1e-9);
  EXPECT_GT(missed->time.count(), 0.4);
}

// The share is what records may fill by the configuration; beside it stand all questions.
TEST(BusBudget, WhatRecordsReallyTakeCountsBesideQuestions) {
  const BusDemand records = axis(0.1, 20.0, 4, 0.09);
  EXPECT_FALSE(check_bus_budget({watched(records, 0.05, 0.1, 0.3)}, GoalTime{0.0}));
}

// A question of 0.3 s has just begun when the record comes.
TEST(BusBudget, ARecordWaitsForAQuestionUnderWay) {
  BusDemand demand = record(5.0, 5.5, 0.1);
  demand.watch = {0.1, 0.001, 0.3, 100.0, GoalTime{0.0}};
  EXPECT_FALSE(check_bus_budget({demand}, GoalTime{0.0}));
  demand.slots[0].deadline = GoalTime{5.35};
  EXPECT_TRUE(check_bus_budget({demand}, GoalTime{0.0}));
}

// A drive that is started before its queue is filled: what is released at the start costs time as well.
TEST(BusBudget, WhatGoesAfterTheStartCommandIsNotLoadedBefore) {
  BusDemand demand;
  demand.record_bus_time = 0.3;
  demand.slots.assign(8, {GoalTime{-1.0}, GoalTime{0.5}});
  EXPECT_FALSE(check_bus_budget({demand}, GoalTime{0.0}));
  demand.watch = {0.3, 0.001, 0.001, 10.0, GoalTime{1.1}};
  EXPECT_TRUE(check_bus_budget({demand}, GoalTime{0.0}));
}

}  // namespace
}  // namespace interpolated_motion::motion
