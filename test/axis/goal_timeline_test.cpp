#include "interpolated_motion_driver/axis/goal_timeline.h"

#include <gtest/gtest.h>

namespace interpolated_motion::axis {
namespace {

TEST(GoalTimeline, RunsWithTheDriveAtFirst) {
  GoalTimeline timeline;
  timeline.begin(GoalTime{-0.5});
  EXPECT_DOUBLE_EQ(timeline.at(0.0).count(), -0.5);
  EXPECT_DOUBLE_EQ(timeline.at(2.0).count(), 1.5);
}

TEST(GoalTimeline, IsContinuousWhereTheRateChanges) {
  GoalTimeline timeline;
  timeline.begin(GoalTime{1.0});
  timeline.change_rate(2.0, 0.5);
  timeline.change_rate(4.0, 2.0);
  EXPECT_DOUBLE_EQ(timeline.at(1.0).count(), 2.0);
  EXPECT_DOUBLE_EQ(timeline.at(2.0).count(), 3.0);
  EXPECT_DOUBLE_EQ(timeline.at(3.0).count(), 3.5);
  EXPECT_DOUBLE_EQ(timeline.at(4.0).count(), 4.0);
  EXPECT_DOUBLE_EQ(timeline.at(5.0).count(), 6.0);
}

TEST(GoalTimeline, TheLastChangeAtAnInstantCounts) {
  GoalTimeline timeline;
  timeline.begin(GoalTime{0.0});
  timeline.change_rate(1.0, 3.0);
  timeline.change_rate(1.0, 0.5);
  EXPECT_DOUBLE_EQ(timeline.at(2.0).count(), 1.5);
}

TEST(GoalTimeline, ForgetsOnlyWhatIsLongPast) {
  GoalTimeline timeline;
  timeline.begin(GoalTime{0.0});
  double goal = 0.02;
  for (int i = 1; i <= 5000; ++i) {
    EXPECT_NEAR(timeline.at(0.02 * i).count(), goal, 1e-9);
    const double rate = i % 2 == 0 ? 1.001 : 0.999;
    timeline.change_rate(0.02 * i, rate);
    goal += 0.02 * rate;
  }
  EXPECT_NEAR(timeline.at(0.02 * 4900 + 0.01).count(), timeline.at(0.02 * 4900).count() + 0.01 * 1.001, 1e-9);
}

}  // namespace
}  // namespace interpolated_motion::axis
