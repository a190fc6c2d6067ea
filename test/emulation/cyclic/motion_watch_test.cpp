#include "interpolated_motion_driver/emulation/cyclic/motion_watch.h"

#include <gtest/gtest.h>

namespace interpolated_motion::emulation {
namespace {

TEST(MotionWatch, AMotionBeginsWithTheFirstChangeOfAFollowedDemand) {
  MotionWatch watch(3);
  watch.take(false, 0.0);
  watch.take(false, 1.0);  // pushed by hand
  EXPECT_FALSE(watch.moving());
  watch.take(true, 1.0);
  watch.take(true, 1.0);
  EXPECT_FALSE(watch.moving());
  watch.take(true, 1.5);
  EXPECT_TRUE(watch.moving());
  EXPECT_EQ(watch.samples(), 0);
  watch.take(true, 2.0);
  EXPECT_EQ(watch.samples(), 1);
}

TEST(MotionWatch, AShortStandstillBelongsToTheMotionALongOneEndsIt) {
  MotionWatch watch(3);
  watch.take(true, 0.0);
  watch.take(true, 1.0);
  watch.take(true, 1.0);
  watch.take(true, 1.0);
  EXPECT_TRUE(watch.moving());
  watch.take(true, 2.0);
  EXPECT_EQ(watch.samples(), 3);
  for (int i = 0; i < 3; ++i) watch.take(true, 2.0);
  EXPECT_FALSE(watch.moving());
  EXPECT_EQ(watch.samples(), 5) << "of the last one that moved or stood for a moment";
  watch.take(true, 3.0);
  EXPECT_TRUE(watch.moving());
  EXPECT_EQ(watch.samples(), 0);
}

TEST(MotionWatch, ADriveThatNoLongerFollowsHasEndedItsMotion) {
  MotionWatch watch(3);
  watch.take(true, 0.0);
  watch.take(true, 1.0);
  watch.take(false, 2.0);
  EXPECT_FALSE(watch.moving());
  watch.take(true, 3.0);
  EXPECT_FALSE(watch.moving()) << "it has braked";
}

}  // namespace
}  // namespace interpolated_motion::emulation
