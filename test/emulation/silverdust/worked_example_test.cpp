#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host.h"

// The worked example of "Interpolated Motion" (QCI-TD044) in the emulated SilverDust, through the wire.
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

TEST(SilverDustWorkedExample, WorkedExampleReachesItsMarks) {
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
TEST(SilverDustWorkedExample, EachTickOfTheWorkedExampleIsThatOfContinuousTime) {
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

TEST(SilverDustWorkedExample, ObservedOrNotTheMotionIsTheSame) {
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
