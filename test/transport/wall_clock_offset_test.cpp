#include "interpolated_motion_driver/transport/wall_clock_offset.h"

#include <gtest/gtest.h>

namespace interpolated_motion::transport {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr HostDuration kAhead =
    std::chrono::hours(50);  // the wall clock was at this when the host clock began

HostTime host(int ms) { return HostTime(milliseconds(ms)); }
HostDuration wall(int ms) { return kAhead + milliseconds(ms); }

TEST(WallClockOffset, AStampGetsTheTimeOfTheHostClock) {
  WallClockOffset offset;
  offset.measure(host(1000), wall(1000), host(1000));
  EXPECT_EQ(offset.host_time_of(wall(990)), host(990));
  EXPECT_EQ(offset.host_time_of(wall(1000)), host(1000));
}

TEST(WallClockOffset, TheFirstReadingIsWrongByHalfTheTimeItTookAtMost) {
  WallClockOffset early;
  early.measure(host(1000), wall(1000), host(1040));
  EXPECT_EQ(early.host_time_of(wall(900)), host(920));
  WallClockOffset late;
  late.measure(host(1000), wall(1040), host(1040));
  EXPECT_EQ(late.host_time_of(wall(900)), host(880));
}

TEST(WallClockOffset, AReadingThatWasInterruptedChangesNothing) {
  WallClockOffset offset;
  offset.measure(host(1000), wall(1000), host(1000));
  offset.measure(host(2000), wall(2050), host(2050));  // put off before the wall clock was read
  EXPECT_EQ(offset.host_time_of(wall(2000)), host(2000));
  offset.measure(host(3000), wall(3000), host(3050));  // and after
  EXPECT_EQ(offset.host_time_of(wall(2990)), host(2990));
}

TEST(WallClockOffset, AQuickReadingMendsASlowOne) {
  WallClockOffset offset;
  offset.measure(host(1000), wall(1000), host(1040));
  offset.measure(host(2000), wall(2000), host(2001));
  EXPECT_GE(offset.host_time_of(wall(1900)), host(1900));
  EXPECT_LE(offset.host_time_of(wall(1900)), host(1901));
}

TEST(WallClockOffset, AWallClockThatWasSetIsFollowed) {
  WallClockOffset offset;
  offset.measure(host(1000), wall(1000), host(1001));
  offset.measure(host(2000), wall(2000) + seconds(5), host(2000));
  EXPECT_EQ(offset.host_time_of(wall(1990) + seconds(5)), host(1990));
}

TEST(WallClockOffset, StampsThatCannotBeAreOfNow) {
  WallClockOffset offset;
  offset.measure(host(100000), wall(100000), host(100000));
  EXPECT_EQ(offset.host_time_of(wall(100001)), host(100000));
  EXPECT_EQ(offset.host_time_of(wall(40000)), host(100000));
  EXPECT_EQ(offset.host_time_of(wall(40001)), host(40001));
}

}  // namespace
}  // namespace interpolated_motion::transport
