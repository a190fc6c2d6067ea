#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "host.h"

// What the emulated SilverDust makes of a segment, through the wire, held against "Interpolated Motion"
// (QCI-TD044).
namespace interpolated_motion::emulation {
namespace {

constexpr double kUnitsPerCount = 67108864.0;  // 2^26 velocity units are 1 count/tick at 4000 counts/rev

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

}  // namespace
}  // namespace interpolated_motion::emulation
