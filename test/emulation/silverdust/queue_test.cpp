#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>

#include "host.h"

// The queue of the emulated SilverDust through the wire: how segments enter and leave it, and how an
// operation ends, held against "Interpolated Motion" (QCI-TD044).
namespace interpolated_motion::emulation {
namespace {

TEST(SilverDustQueue, SegmentGoesToRegistersAndTimeCountsDown) {
  SerialHost host;
  host.prepare();
  host.queue("100000 1073741824 1000 2000");
  host.expect_ack("253");
  EXPECT_EQ(host.read(20), 1073741824);
  EXPECT_EQ(host.read(21), 1000);
  EXPECT_EQ(host.read(22), 2000);
  EXPECT_EQ(host.read(23), 1000);
  const HostTime before = host.world.now();
  const std::int32_t first = host.read(18);
  const HostDuration exchange = host.world.now() - before;
  host.run(milliseconds(1200) - exchange);
  EXPECT_NEAR(first - host.read(18), 10000, 1) << "1.2 s are 10000 ticks of 120 us";
  EXPECT_EQ(host.read(17), 0) << "the queue does not touch register 17";
}

void expect_full_after(int depth) {
  SilverDustParameters parameters;
  parameters.queue_depth = depth;
  SerialHost host(parameters);
  host.prepare();
  const std::string segment = "1000000 1073741824 1000 2000";
  for (int i = 0; i < depth; ++i) host.queue(segment);
  EXPECT_EQ(host.command("25 " + segment), "! 10 0019 0006");
  host.expect_ack("253 0 0");
  host.queue(segment);
  EXPECT_EQ(host.command("25 " + segment), "! 10 0019 0006") << "one is executed, " << depth << " wait";
  host.expect_ack("3 0");
  host.run(milliseconds(10));
  host.expect_ack("254");
  for (int i = 0; i < depth; ++i) host.queue(segment);
  EXPECT_EQ(host.drive->counters().segments_accepted, static_cast<std::uint64_t>(2 * depth + 1));
  EXPECT_EQ(host.drive->counters().segments_refused_full, 2U);
}

TEST(SilverDustQueue, FourStageQueue) { expect_full_after(4); }
TEST(SilverDustQueue, EightStageQueue) { expect_full_after(8); }

// IMS to the global address: nobody answers, and all drives begin at their next tick.
TEST(SilverDustQueue, OneStartBeginsAllDrivesOfTheLine) {
  SerialHost host;
  SilverDustParameters parameters;
  parameters.address = 17;
  parameters.tick_phase = std::chrono::microseconds(50);
  SilverDust& other = host.world.add<SilverDust>(host.line, parameters);
  host.observe();
  HostTime other_began = kNever;
  other.set_sample_observer([&other_began](const SilverDustSample& sample) {
    if (sample.ticks_since_start == 0) other_began = sample.time;
  });
  host.prepare();
  host.queue("100000 1073741824 1000 2000");
  EXPECT_EQ(host.ask("@17 11 17 0"), "* 11|");
  EXPECT_EQ(host.ask("@17 25 100000 1073741824 1000 2000"), "* 11|");
  EXPECT_EQ(host.ask("@255 253 0 0"), "");
  EXPECT_TRUE(host.trajectory_active());
  EXPECT_EQ(host.ask("@17 21"), "# 11 0015 0088|");
  ASSERT_NE(other_began, kNever);
  const HostDuration apart = other_began - host.sample_at(0).time;
  EXPECT_LE(std::abs(seconds(apart)), 120e-6);
  EXPECT_NE(apart, HostDuration::zero()) << "each has its own ticks";
}

// 1000 rpm are 8 counts/tick; register 19 takes (5368709 / 2) / 2^26 = 0.04 counts/tick from it each tick, so
// it rests after 200 ticks and 800 counts.
TEST(SilverDustQueue, AnEmptyQueueStopsWithRegister19) {
  SerialHost host;
  host.observe();
  host.prepare("5368709");
  host.queue("1500 1073741824 1073742 536870912");
  host.expect_ack("253 0 0");
  host.run(milliseconds(180.0 + 12));
  EXPECT_TRUE(host.trajectory_active()) << "still braking";
  EXPECT_EQ(host.take_polling() & 0x2000U, 0U);
  host.run(milliseconds(30));
  EXPECT_FALSE(host.trajectory_active());
  EXPECT_EQ(host.take_polling() & 0x2000U, 0x2000U);
  EXPECT_NEAR(host.sample_at(1500).demand, 8000.0, 0.02);
  EXPECT_NEAR(host.samples.back().demand - host.sample_at(1500).demand, 800.0, 0.1);
  EXPECT_NEAR(static_cast<double>(host.samples.back().ticks_since_start), 1700.0, 1.0);
  EXPECT_EQ(host.drive->counters().underruns, 1U);
  EXPECT_EQ(host.drive->counters().minimum_fill, 0);
}

TEST(SilverDustQueue, WithoutADecelerationAnUnderrunStopsAtOnce) {
  SerialHost host;
  host.observe();
  host.prepare("0");
  host.queue("1500 1073741824 1073742 536870912");
  host.expect_ack("253 0 0");
  host.run(milliseconds(250));
  EXPECT_EQ(host.samples.back().ticks_since_start, 1500);
  EXPECT_EQ(host.samples.back().demand, host.sample_at(1500).demand);
}

TEST(SilverDustQueue, StartWithAnEmptyQueueIsAnUnderrun) {
  SerialHost host;
  host.prepare();
  host.expect_ack("253 0 0");
  host.run(milliseconds(1));
  EXPECT_FALSE(host.trajectory_active());
  EXPECT_EQ(host.take_polling(), 0x2000U);
  EXPECT_EQ(host.drive->counters().underruns, 1U);
}

TEST(SilverDustQueue, AfterTheEndTheQueueFillsUp) {
  SilverDustParameters parameters;
  parameters.queue_depth = 4;
  SerialHost host(parameters);
  host.prepare();
  host.queue("0 0 0 0");
  host.expect_ack("253 0 0");
  for (int i = 0; i < 4; ++i) host.queue("100 1073741824 1000 1000");
  EXPECT_EQ(host.command("25 100 1073741824 1000 1000"), "! 10 0019 0006");
  host.run(milliseconds(500));
  EXPECT_EQ(host.command("25 100 1073741824 1000 1000"), "! 10 0019 0006") << "for ever";
}

TEST(SilverDustQueue, StopEndsItWithTheChosenDeceleration) {
  SerialHost host;
  host.observe();
  host.prepare();
  host.queue("100000 1073741824 67108864 536870912");
  host.expect_ack("253 0 0");
  host.run(milliseconds(50));
  host.expect_ack("3 33554432");  // 0.5 counts/tick^2 in the scale of ordinary commands
  host.run(milliseconds(20));
  EXPECT_FALSE(host.trajectory_active());
  EXPECT_EQ(host.take_polling() & 0x2000U, 0x2000U);
  double largest = 0.0;
  for (std::size_t k = 1; k < host.samples.size(); ++k) {
    largest = std::max(largest, host.samples[k - 1].velocity - host.samples[k].velocity);
  }
  EXPECT_EQ(largest, 0.5);
  EXPECT_EQ(host.samples.back().velocity, 0.0);
}

TEST(SilverDustQueue, TooEarlyAnEndStopsAtOnce) {
  SerialHost host;
  host.observe();
  host.prepare();
  host.queue("100 1073741824 67108864 536870912");
  host.queue("0 1073741824 67108864 536870912");
  host.expect_ack("253 0 0");
  host.run(milliseconds(60));
  EXPECT_EQ(host.samples.back().ticks_since_start, 101);
  EXPECT_EQ(host.samples.back().velocity, 0.0);
  EXPECT_EQ(host.samples.back().demand, host.sample_at(100).demand + 8.0);
}

}  // namespace
}  // namespace interpolated_motion::emulation
