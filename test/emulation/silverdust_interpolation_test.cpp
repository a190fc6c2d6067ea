#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "silverdust_host.h"

// Interpolated motion of the emulated SilverDust through the wire, held against "Interpolated Motion"
// (QCI-TD044).
namespace interpolated_motion::emulation {
namespace {

constexpr double kUnitsPerCount = 67108864.0;  // 2^26 velocity units are 1 count/tick at 4000 counts/rev

void start_worked_example(SerialHost& host) {
  host.prepare();
  for (std::size_t i = 0; i < 4; ++i) host.queue(worked_example()[i]);
  host.expect_ack("253 0 0");
  host.queue(worked_example()[4]);
}

// Every reply of the exchange the facts of the protocol give, from the first poll to the controlled stop.
TEST(SilverDustWire, TranscriptOfAStream) {
  SilverDustParameters parameters;
  parameters.queue_depth = 4;
  parameters.done_bit_of_short_commands = false;
  SerialHost host(parameters);
  EXPECT_EQ(host.ask("@16 0"), "* 10|");
  EXPECT_EQ(host.ask("@16"), "* 10|") << "the short form of POL";
  EXPECT_EQ(host.ask("@16 1 65535"), "* 10|");
  EXPECT_EQ(host.ask("@16 20"), "# 10 0014 00F3|");
  EXPECT_EQ(host.ask("@16 163"), "* 10|");
  EXPECT_EQ(host.ask("@16 146"), "* 10|");
  EXPECT_EQ(host.ask("@16 227"), "* 10|");
  EXPECT_EQ(host.ask("@16 145"), "* 10|");
  EXPECT_EQ(host.ask("@16 11 17 0"), "* 10|");
  EXPECT_EQ(host.ask("@16 11 19 1073742"), "* 10|");
  EXPECT_EQ(host.ask("@16 254"), "* 10|");
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(host.ask("@16 25 " + worked_example()[static_cast<std::size_t>(i)]), "* 10|");
  }
  EXPECT_EQ(host.ask("@16 25 0 92000 536871 536870912"), "! 10 0019 0006|") << "four are waiting";
  EXPECT_EQ(host.ask("@16 253 0 0"), "* 10|");
  EXPECT_EQ(host.ask("@16 25 0 92000 536871 536870912"), "* 10|") << "the first entry has left the queue";
  EXPECT_EQ(host.ask("@16 253 0 0"), "! 10 00FD 0002|") << "busy";
  EXPECT_EQ(host.ask("@16 21"), "# 10 0015 0088|");
  host.run(milliseconds(1300));
  EXPECT_EQ(host.ask("@16 12 1"), "# 10 000C 0001 6760|");
  EXPECT_EQ(host.ask("@16 21"), "# 10 0015 0080|");
  EXPECT_EQ(host.ask("@16 0"), "# 10 0000 2000|");
  EXPECT_EQ(host.ask("@16 3 0"), "* 10|");
  EXPECT_EQ(host.ask("@16 25 4000 1073741824 1073742"), "! 10 0019 0005|");
  EXPECT_EQ(host.ask("@16 200"), "! 10 00C8 0001|");
}

// Inner marks by the way the drive integrates, all with the end at 92000: half a tick of 8, 16 and 8
// counts/tick apart from each other.
struct Marks {
  Integration integration;
  double lead;  // of the marks, ticks
};

TEST(SilverDustInterpolation, WorkedExampleReachesItsMarks) {
  for (const Marks marks : {Marks{Integration::MeanVelocity, 0.0}, Marks{Integration::VelocityFirst, 0.5},
                            Marks{Integration::PositionFirst, -0.5}}) {
    for (const AccelerationRounding rounding :
         {AccelerationRounding::Truncated, AccelerationRounding::Exact}) {
      SilverDustParameters parameters;
      parameters.integration = marks.integration;
      parameters.acceleration_rounding = rounding;
      SerialHost host(parameters);
      host.observe();
      start_worked_example(host);
      host.run(milliseconds(1300));
      EXPECT_EQ(host.sample_at(0).demand, 0.0);
      EXPECT_NEAR(host.sample_at(4000).demand, 28000.0 + 8 * marks.lead, 0.02);
      EXPECT_NEAR(host.sample_at(7000).demand, 72000.0 + 16 * marks.lead, 0.02);
      EXPECT_NEAR(host.sample_at(8000).demand, 84000.0 + 8 * marks.lead, 0.02);
      EXPECT_EQ(host.sample_at(10001).demand, 92000.0);
      EXPECT_EQ(host.samples.back().ticks_since_start, 10001) << "the last segment takes one servo cycle";
      EXPECT_FALSE(host.samples.back().interpolating);
      EXPECT_EQ(host.command("12 1"), "# 10 000C 0001 6760");
      EXPECT_EQ(host.read(0), 92000);
      EXPECT_EQ(host.drive->counters().underruns, 0U);
      EXPECT_EQ(host.drive->counters().segments_executed, 5U);
      EXPECT_EQ(host.drive->counters().minimum_fill, 4) << "the end was queued right after the start";
    }
  }
}

/// Counts travelled in continuous time: a ramp with `slope` (units/tick) from `v0` to `v1`, then hold.
double ramp_then_hold(double v0, double v1, double slope, double ticks) {
  const double ramp = std::min(ticks, std::abs(v1 - v0) / slope);
  const double end = v0 + (v1 > v0 ? slope : -slope) * ramp;
  return (0.5 * (v0 + end) * ramp + v1 * (ticks - ramp)) / kUnitsPerCount;
}

// The interior against the continuous-time law. What differs is the rounding of the last acceleration: half a
// unit over 2000 ticks are 0.015 counts.
TEST(SilverDustInterpolation, EachTickOfTheWorkedExampleIsThatOfContinuousTime) {
  SerialHost host;
  host.observe();
  start_worked_example(host);
  host.run(milliseconds(1300));
  const double quarter = 536870912.0;
  const double half = 1073741824.0;
  const double slope = 1073742.0 / 2.0;
  const double third_start =
      ramp_then_hold(0, quarter, slope, 4000) + ramp_then_hold(quarter, half, slope, 3000);
  const double fourth_start = third_start + ramp_then_hold(half, quarter, slope, 1000);
  int checked = 0;
  for (const auto& sample : host.samples) {
    const auto k = static_cast<double>(sample.ticks_since_start);
    if (!sample.interpolating || k > 10000) continue;
    double expected = 0.0;
    if (k <= 4000) {
      expected = ramp_then_hold(0, quarter, slope, k);
    } else if (k <= 7000) {
      expected = ramp_then_hold(0, quarter, slope, 4000) + ramp_then_hold(quarter, half, slope, k - 4000);
    } else if (k <= 8000) {
      expected = third_start + ramp_then_hold(half, quarter, slope, k - 7000);
    } else {
      expected = fourth_start + ramp_then_hold(quarter, 0, slope / 2.0, k - 8000);
    }
    ASSERT_NEAR(sample.demand, expected, 0.02) << "tick " << k;
    ++checked;
  }
  EXPECT_EQ(checked, 10001);
}

TEST(SilverDustInterpolation, SegmentGoesToRegistersAndTimeCountsDown) {
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

TEST(SilverDustInterpolation, FourStageQueue) { expect_full_after(4); }
TEST(SilverDustInterpolation, EightStageQueue) { expect_full_after(8); }

// 1000 rpm are 8 counts/tick; register 19 takes (5368709 / 2) / 2^26 = 0.04 counts/tick from it each tick, so
// it rests after 200 ticks and 800 counts.
TEST(SilverDustInterpolation, AnEmptyQueueStopsWithRegister19) {
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

TEST(SilverDustInterpolation, WithoutADecelerationAnUnderrunStopsAtOnce) {
  SerialHost host;
  host.observe();
  host.prepare("0");
  host.queue("1500 1073741824 1073742 536870912");
  host.expect_ack("253 0 0");
  host.run(milliseconds(250));
  EXPECT_EQ(host.samples.back().ticks_since_start, 1500);
  EXPECT_EQ(host.samples.back().demand, host.sample_at(1500).demand);
}

TEST(SilverDustInterpolation, StartWithAnEmptyQueueIsAnUnderrun) {
  SerialHost host;
  host.prepare();
  host.expect_ack("253 0 0");
  host.run(milliseconds(1));
  EXPECT_FALSE(host.trajectory_active());
  EXPECT_EQ(host.take_polling(), 0x2000U);
  EXPECT_EQ(host.drive->counters().underruns, 1U);
}

TEST(SilverDustInterpolation, AfterTheEndTheQueueFillsUp) {
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

// From 2^31 - 1001, projected by 2^30 beyond the end of the range: still forward. 1000 ticks of ramp to 8
// counts/tick and 125 at that speed are 5000 counts; the end is 9500 counts from the start.
TEST(SilverDustInterpolation, PositionsWrapAround) {
  SilverDustParameters parameters;
  parameters.initial_position = 2147482647;
  SerialHost host(parameters);
  host.observe();
  host.prepare();
  host.queue("1125 -1073742825 1073742 536870912");
  host.queue("2000 -2147475149 1073742 536870912");
  host.queue("0 0 0 0");
  host.expect_ack("253 0 0");
  host.run(milliseconds(500));
  EXPECT_NEAR(host.sample_at(1125).demand, 2147482647.0 + 5000.0, 0.02);
  EXPECT_EQ(host.samples.back().demand, 2147482647.0 + 9500.0);
  EXPECT_EQ(host.read(1), -2147475149);
}

// 0.5 counts/tick^2 are an acceleration of 2^26: forward for 100 ticks, back to rest, backwards to 0.
TEST(SilverDustInterpolation, ReversalThroughRest) {
  SerialHost host;
  host.observe();
  host.prepare();
  host.queue("100 1073741824 67108864 536870912");  // 16 ticks to 8 counts/tick, then 84 at it
  host.queue("100 1000 67108864 536870912");        // comes to rest at 1000
  host.queue("100 -1073741824 67108864 268435456");
  host.queue("200 0 67108864 268435456");
  host.queue("0 0 67108864 268435456");
  host.expect_ack("253 0 0");
  host.run(milliseconds(100));
  EXPECT_NEAR(host.sample_at(100).demand, 16 * 4.0 + 84 * 8.0, 1e-9);
  EXPECT_EQ(host.sample_at(200).demand, 1000.0);
  EXPECT_EQ(host.sample_at(200).velocity, 0.0);
  EXPECT_NEAR(host.sample_at(300).demand, 1000.0 - (8 * 2.0 + 92 * 4.0), 1e-9);
  EXPECT_EQ(host.samples.back().demand, 0.0);
}

// A direction that turns while the axis moves: it brakes with the new segment's acceleration first.
TEST(SilverDustInterpolation, OppositeDirectionBrakesBeforeItTurns) {
  SerialHost host;
  host.observe();
  host.prepare();
  host.queue("100 1073741824 67108864 536870912");
  host.queue("116 -1073741824 67108864 536870912");
  host.expect_ack("253 0 0");
  host.run(milliseconds(60));
  for (int k = 100; k < 132; ++k) {
    const double change = host.sample_at(k + 1).velocity - host.sample_at(k).velocity;
    ASSERT_EQ(change, -0.5) << "tick " << k;
  }
  EXPECT_EQ(host.sample_at(132).velocity, -8.0);
  EXPECT_EQ(host.sample_at(200).velocity, -8.0);
}

TEST(SilverDustInterpolation, AccelerationZeroKeepsTheVelocity) {
  SerialHost host;
  host.observe();
  host.prepare();
  host.queue("100 1073741824 67108864 536870912");
  host.queue("1000 1073741824 0 1");
  host.expect_ack("253 0 0");
  host.run(milliseconds(100));
  EXPECT_EQ(host.sample_at(700).velocity, 8.0);
  EXPECT_EQ(host.sample_at(700).demand - host.sample_at(100).demand, 4800.0);
}

// "Do not set as the ending velocity of the segment to (zero); this will cause the IMS to undershoot the
// desired ending position": 8 counts/tick end after 64 counts, far from the position.
TEST(SilverDustInterpolation, EndingVelocityZeroUndershoots) {
  SerialHost host;
  host.observe();
  host.prepare();
  host.queue("100 1073741824 67108864 536870912");
  host.queue("100 1000 67108864 0");
  host.queue("0 1000 67108864 0");
  host.expect_ack("253 0 0");
  host.run(milliseconds(40));
  EXPECT_NEAR(host.samples.back().demand - host.sample_at(100).demand, 64.0, 1e-9);
  EXPECT_LT(host.samples.back().demand, 850.0);
}

// A segment that comes to a halt lands on its position for any of them, and never brakes with more than twice
// its acceleration. The seeds make runs of 8 counts/tick that end anywhere in the reach of the braking ramp.
TEST(SilverDustInterpolation, HaltsLandExactly) {
  std::uint64_t random = 20240607;
  for (int i = 0; i < 40; ++i) {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    const auto position = 1200 + static_cast<int>(random >> 40) % 5000;
    const auto acceleration = 2'000'000 + static_cast<int>(random >> 33) % 60'000'000;
    const double step = std::floor(acceleration / 2.0) / kUnitsPerCount;
    SerialHost host;
    host.observe();
    host.prepare();
    host.queue("40 1073741824 67108864 536870912");
    host.queue("4000 " + std::to_string(position) + " " + std::to_string(acceleration) + " 536870912");
    host.queue("0 0 0 0");
    const double braking = 8.0 * 8.0 / (2.0 * step);
    if (40 * 8 + braking > position) continue;
    host.expect_ack("253 0 0");
    host.run(milliseconds(600));
    ASSERT_EQ(host.sample_at(4040).demand, position) << i;
    for (std::size_t k = 1; k < host.samples.size(); ++k) {
      const double change = host.samples[k].velocity - host.samples[k - 1].velocity;
      if (host.samples[k].ticks_since_start <= 40) continue;
      ASSERT_GE(change, -2.0 * step) << "case " << i << ", sample " << k;
    }
  }
}

// Other encoders: 4000 rpm are 0.008 counts/tick per count of a revolution, exactly.
TEST(SilverDustInterpolation, CountsPerRevolutionScaleExactly) {
  for (const int counts : {500, 1000, 4096, 5000, 8000, 16000, 65536}) {
    SilverDustParameters parameters;
    parameters.counts_per_revolution = counts;
    SerialHost host(parameters);
    host.observe();
    host.prepare();
    host.queue("7500 1073741824 2147483647 536870912");  // a quarter of the full scale within a tick
    host.queue("8000 " + std::to_string(counts * 25) + " 2000000 536870912");
    host.queue("0 0 0 0");
    host.expect_ack("253 0 0");
    host.run(milliseconds(2000));
    const double first = host.sample_at(1).demand;
    EXPECT_NEAR(host.sample_at(7500).demand - first, 7499.0 * 0.002 * counts, 1e-9 * counts);
    EXPECT_EQ(host.sample_at(15500).demand, 25.0 * counts) << "900 ms at 16.7 rev/s are 15 revolutions";
    EXPECT_EQ(host.read(1), counts * 25) << counts;
  }
}

TEST(SilverDustInterpolation, StopEndsItWithTheChosenDeceleration) {
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

TEST(SilverDustInterpolation, TooEarlyAnEndStopsAtOnce) {
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

// 200 ppm fast: 1.2 s of the host are 10002 ticks.
TEST(SilverDustInterpolation, TheDriveKeepsItsOwnTime) {
  SilverDustParameters parameters;
  parameters.clock_error_ppm = 200.0;
  SerialHost host(parameters);
  host.observe();
  host.prepare();
  host.queue("100000 1073741824 1073742 536870912");
  host.expect_ack("253 0 0");
  host.run(milliseconds(1300));
  const HostDuration ten_thousand = host.sample_at(10000).time - host.sample_at(0).time;
  EXPECT_NEAR(static_cast<double>(ten_thousand.count()), 1.2e9 / 1.0002, 2.0);
}

TEST(SilverDustInterpolation, ObservedOrNotTheMotionIsTheSame) {
  SerialHost observed;
  observed.observe();
  SerialHost unobserved;
  for (SerialHost* host : {&observed, &unobserved}) {
    start_worked_example(*host);
    host->run(milliseconds(333));
    host->read(1);
    host->read(7);
    host->expect_ack("3 0");
    host->run(milliseconds(777));
    host->read(1);
  }
  EXPECT_EQ(observed.log, unobserved.log) << "texts and times to the nanosecond";
  EXPECT_EQ(observed.drive->position(), unobserved.drive->position());
}

}  // namespace
}  // namespace interpolated_motion::emulation
