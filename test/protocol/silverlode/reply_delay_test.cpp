#include "interpolated_motion_driver/protocol/silverlode/reply_delay.h"

#include <gtest/gtest.h>

namespace interpolated_motion::silverlode {
namespace {

using std::chrono::milliseconds;

TEST(ReplyDelay, IsThatOfTheFirstReplyAndThenGoesOneThirtySecondOfTheWay) {
  ReplyDelay delay;
  EXPECT_EQ(delay.mean(), HostDuration::zero());
  delay.add(milliseconds(10));
  EXPECT_EQ(delay.mean(), milliseconds(10));
  delay.add(milliseconds(42));
  EXPECT_EQ(delay.mean(), milliseconds(11));
}

// (31/32)^200 is below 0.002: nothing is left of what was.
TEST(ReplyDelay, ForgetsWhatWas) {
  ReplyDelay delay;
  delay.add(milliseconds(100));
  for (int i = 0; i < 200; ++i) delay.add(milliseconds(2));
  EXPECT_LT(delay.mean(), std::chrono::microseconds(2200));
}

}  // namespace
}  // namespace interpolated_motion::silverlode
