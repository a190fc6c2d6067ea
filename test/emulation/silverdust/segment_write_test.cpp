#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "host.h"

// "Any use of these registers (18 and 20-23) while in an IMS operation could cause a program or movement
// error"
// ("Interpolated Motion"): the operation works on them.
namespace interpolated_motion::emulation {
namespace {

/// To 1000 rpm (8 counts a tick) in 1000 ticks (0.12 s), and on at that for a second.
constexpr const char* kGoing = "8000 1073741824 1073742 536870912";

class SegmentWrite : public testing::Test {
 protected:
  explicit SegmentWrite(const SilverDustParameters& parameters = {}) : host(parameters) {
    host.prepare();
    host.queue(kGoing);
  }

  void start_and_run(double ms) {
    host.expect_ack("253 0 0");
    host.run(milliseconds(ms));
  }

  /// Of the axis, counts a tick: both words of register 7 say it, 32767 being 32 counts a tick.
  double speed() { return static_cast<std::int16_t>(host.read(7) & 0xFFFF) * 32.0 / 32767.0; }

  SerialHost host;
};

TEST_F(SegmentWrite, TheVelocityRampsToWhatIsWritten) {
  start_and_run(250);
  EXPECT_NEAR(speed(), 8.0, 0.01);
  host.expect_ack("11 22 1073741824");
  host.run(milliseconds(200));
  EXPECT_NEAR(speed(), 16.0, 0.01);
  EXPECT_EQ(host.read(22), 1073741824);
}

TEST_F(SegmentWrite, TheAccelerationIsThatWhichIsWritten) {
  start_and_run(60);
  host.expect_ack("11 21 0");
  host.run(milliseconds(20));
  const double held = speed();
  EXPECT_GT(held, 2.0);
  EXPECT_LT(held, 7.0);
  host.run(milliseconds(200));
  EXPECT_NEAR(speed(), held, 0.01);
}

TEST_F(SegmentWrite, ThePositionDecidesTheDirection) {
  start_and_run(250);
  host.expect_ack("11 20 -1073741824");
  host.run(milliseconds(300));  // 0.24 s from 8 to -8 counts a tick
  EXPECT_NEAR(speed(), -8.0, 0.01);
}

TEST_F(SegmentWrite, TheTimeIsWhatIsLeft) {
  host.queue("8000 1073741824 1073742 1073741824");
  start_and_run(250);
  host.expect_ack("11 18 50");  // 6 ms
  host.run(milliseconds(250));
  EXPECT_NEAR(speed(), 16.0, 0.01) << "the next segment";
  EXPECT_EQ(host.drive->counters().segments_executed, 2U);
}

TEST_F(SegmentWrite, ATimeThatIsOverEndsTheSegment) {
  for (const char* time : {"0", "-5"}) {
    SerialHost other;
    other.prepare();
    other.queue(kGoing);
    other.expect_ack("253 0 0");
    other.run(milliseconds(250));
    other.expect_ack(std::string("11 18 ") + time);
    other.run(milliseconds(300));
    EXPECT_EQ(other.drive->counters().underruns, 1U);
    EXPECT_FALSE(other.trajectory_active());
  }
}

// From 8 counts a tick to rest on 20000: in 1000 ticks as the segment says, in 500 with twice the
// deceleration.
TEST(SegmentWriteOfTheDeceleration, BrakesLaterAndStopsAtTheSamePlace) {
  for (const bool written : {false, true}) {
    SerialHost host;
    host.prepare();
    host.queue("8000 20000 1073742 536870912");
    host.queue("0 20000 1073742 536870912");
    host.observe();
    host.expect_ack("253 0 0");
    host.run(milliseconds(200));
    if (written) host.expect_ack("11 23 2147483");
    host.run(milliseconds(1000));
    double before = 0.0;
    int braking = 0;
    for (const SilverDustSample& sample : host.samples) {
      const double step = sample.demand - before;
      before = sample.demand;
      if (sample.ticks_since_start > 1100 && step > 0.005 && step < 7.99) ++braking;
    }
    EXPECT_NEAR(braking, written ? 500 : 1000, 3);
    EXPECT_EQ(host.read(0), 20000);
  }
}

class SegmentWriteRefused : public SegmentWrite {
 protected:
  SegmentWriteRefused() : SegmentWrite(refusing()) {}

  static SilverDustParameters refusing() {
    SilverDustParameters parameters;
    parameters.replies.segment_writes = SegmentWriteReply::CommandError;
    return parameters;
  }
};

TEST_F(SegmentWriteRefused, IsAProgramErrorAndMovesNothing) {
  start_and_run(250);
  host.take_polling();
  host.expect_ack("11 22 1073741824");
  EXPECT_NE(host.take_polling() & 0x1000U, 0U);
  host.run(milliseconds(200));
  EXPECT_NEAR(speed(), 8.0, 0.01);
  host.expect_ack("11 24 5");  // no register of IMS
  EXPECT_EQ(host.take_polling() & 0x1000U, 0U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
