#include "interpolated_motion_driver/trajectory/time_law.h"

#include <gtest/gtest.h>

namespace interpolated_motion::trajectory {
namespace {

/// From 1 to 0.5 in 1 .. 1.4 s, by a slope that falls to -2.5 /s and comes back.
TimeLaw slower() {
  TimeLaw law;
  law.bend(GoalTime{1.0}, 0.0, -12.5);
  law.bend(GoalTime{1.2}, -2.5, 12.5);
  law.settle(GoalTime{1.4}, 0.5);
  return law;
}

TEST(TimeLaw, IsNominalAtFirst) {
  const TimeLaw law;
  EXPECT_TRUE(law.is_identity());
  for (const double t : {-2.0, 0.0, 3.5}) EXPECT_EQ(law.at(GoalTime{t}).nominal.count(), t);
}

// The integral of the rate 1 - 6.25 t^2 over 0.2 s is 0.2 - 6.25 * 0.008 / 3, and 0.5 + 6.25 t^2 from the
// other end.
TEST(TimeLaw, IsTheIntegralOfItsRate) {
  const TimeLaw law = slower();
  EXPECT_FALSE(law.is_identity());
  EXPECT_NEAR(law.at(GoalTime{1.2}).nominal.count(), 1.2 - 6.25 * 0.008 / 3, 1e-15);
  EXPECT_NEAR(law.at(GoalTime{1.2}).rate, 0.75, 1e-15);
  EXPECT_NEAR(law.at(GoalTime{1.4}).nominal.count(), 1.3, 1e-15);
  EXPECT_NEAR(law.at(GoalTime{2.4}).nominal.count(), 1.8, 1e-15);
  EXPECT_EQ(law.final_rate(), 0.5);
  EXPECT_EQ(law.steady_from().count(), 1.4);
}

TEST(TimeLaw, TellsWhen) {
  const TimeLaw law = slower();
  for (double t = 0.1; t < 3.0; t += 0.07) {
    const auto when = law.when(law.at(GoalTime{t}).nominal);
    ASSERT_TRUE(when);
    EXPECT_NEAR(when->count(), t, 1e-12);
  }
}

TEST(TimeLaw, NeverComesBehindAPause) {
  TimeLaw law = slower();
  law.bend(GoalTime{2.0}, -1.0, 1.0);
  law.settle(GoalTime{3.0}, 0.0);
  const GoalTime end = law.at(GoalTime{3.0}).nominal;
  EXPECT_EQ(law.at(GoalTime{9.0}).nominal, end);
  EXPECT_FALSE(law.when(end + GoalTime{1e-6}));
  ASSERT_TRUE(law.when(end));
  EXPECT_NEAR(law.when(end)->count(), 3.0,
              1e-3);  // it comes there with rate 0: to the 1e-9 in its nominal time
}

TEST(TimeLaw, BeginsWithAPauseWhereItBegins) {
  TimeLaw law(0.0, GoalTime{0.0}, GoalTime{0.7});
  law.bend(GoalTime{0.0}, 0.0, 2.0);
  law.settle(GoalTime{1.0}, 1.0);
  EXPECT_EQ(law.when(GoalTime{0.7})->count(), 0.0);
}

TEST(TimeLaw, ForgetsWhatIsOver) {
  TimeLaw law = slower();
  const TimeLaw whole = law;
  law.forget(GoalTime{1.25});
  EXPECT_EQ(law.pieces().size(), 2u);
  for (const double t : {1.25, 1.3, 1.7}) {
    EXPECT_EQ(law.at(GoalTime{t}).nominal, whole.at(GoalTime{t}).nominal);
  }
}

}  // namespace
}  // namespace interpolated_motion::trajectory
