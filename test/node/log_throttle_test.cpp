#include "interpolated_motion_driver/node/log_throttle.h"

#include <chrono>

#include <gtest/gtest.h>

namespace interpolated_motion::node {
namespace {

using std::chrono::milliseconds;

TEST(LogThrottle, SingleLinesPassAsTheyAre) {
  LogThrottle throttle;
  HostTime now{};
  for (int i = 0; i < 5; ++i, now += milliseconds(1000)) EXPECT_EQ(throttle.pass("bad", now), "bad");
}

TEST(LogThrottle, OfAFloodOneLineASecondPassesAndCountsTheOthers) {
  LogThrottle throttle;
  HostTime now{};
  int lines = 0;
  std::string last;
  for (int i = 0; i < 6001; ++i, now += std::chrono::microseconds(500)) {
    if (const auto line = throttle.pass("bad", now)) {
      ++lines;
      last = *line;
    }
  }
  EXPECT_EQ(lines, 4);
  EXPECT_NE(last.find("1999"), std::string::npos) << last;
}

TEST(LogThrottle, AfterTheFloodNothingIsCountedTwice) {
  LogThrottle throttle;
  throttle.pass("bad", HostTime{});
  throttle.pass("bad", HostTime{} + milliseconds(10));
  EXPECT_NE(throttle.pass("bad", HostTime{} + milliseconds(1000))->find("1 like it"), std::string::npos);
  EXPECT_EQ(throttle.pass("bad", HostTime{} + milliseconds(2000)), "bad");
}

}  // namespace
}  // namespace interpolated_motion::node
