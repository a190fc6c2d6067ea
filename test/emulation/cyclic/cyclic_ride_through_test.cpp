#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cyclic_host.h"

// Late and lost target positions at the wire.
namespace interpolated_motion::emulation {
namespace {

TEST(CyclicRideThrough, LostSyncsAndLostTargetsAreRiddenThrough) {
  for (const bool lose_sync : {true, false}) {
    CyclicHost host(stiff_cyclic());
    host.prepare();
    for (int n = 0; n < 60; ++n) {
      const bool lost = n == 20 || n == 30 || n == 31 || (n >= 40 && n < 43);
      if (!lost) {
        host.cycle(n, kStep * n);
      } else if (!lose_sync) {
        host.run_to(host.sync_time(n));
        host.sync();
      } else {
        host.run_to(host.sync_time(n) - ms(5));
        host.target(kStep * n);
      }
    }
    std::uint32_t most_missed = 0;
    for (const CyclicSample& sample : host.samples) {
      most_missed = std::max(most_missed, sample.missed);
      if (sample.time < host.sync_arrival(5)) continue;
      EXPECT_NEAR(sample.demand, ramp_demand(host, sample.time), 1e-6);
      EXPECT_NEAR(sample.velocity, 10000.0, 1e-6);
    }
    EXPECT_EQ(most_missed, 3U);
    EXPECT_EQ(host.read(0x2100, 3), 6U);
    EXPECT_EQ(host.status(), 0x1337U);
    EXPECT_EQ(host.count(0x081), 0U);
  }
}

// After three updates too few the drive faults and brakes: 10 counts/ms at 50000 counts/s^2 = 0.05
// counts/ms^2 take 200 ms and 1000 counts.
TEST(CyclicRideThrough, BeyondTheLimitItFaultsAndBrakes) {
  CyclicHost host(stiff_cyclic());
  host.prepare();
  ASSERT_EQ(host.write(0x6085, 0, 50000, 4), 0U);
  host.start = host.world.now();
  for (int n = 0; n < 20; ++n) host.cycle(n, kStep * n);
  host.run(ms(400));
  const auto emergency = host.take(0x081);
  ASSERT_TRUE(emergency);
  EXPECT_EQ(bytes_of(emergency->frame), (Bytes{0x00, 0x87, 0x11, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(host.take(0x081)) << "once";
  // The last target is reached a period after its SYNC; three more periods may pass.
  const double waited = ms_between(host.sync_arrival(19), emergency->time);
  EXPECT_GT(waited, 40.0);
  EXPECT_LT(waited, 41.5);
  EXPECT_EQ(host.status(), 0x0308U);
  EXPECT_EQ(host.read(0x603F, 0), 0x8700U);
  const auto last = std::find_if(host.samples.rbegin(), host.samples.rend(),
                                 [](const CyclicSample& s) { return s.following; });
  ASSERT_NE(last, host.samples.rend());
  EXPECT_NEAR(last->demand, ramp_demand(host, last->time), 1e-6);
  EXPECT_NEAR(static_cast<std::int32_t>(host.read(0x6064, 0)), last->demand + 1000.0, 0.51);
  double velocity = 10000.0;
  for (auto sample = last.base(); sample != host.samples.end(); ++sample) {
    EXPECT_LE(velocity - sample->velocity, 50.0 * (1 + 1e-9)) << "no harder than 0x6085";
    velocity = sample->velocity;
  }
  EXPECT_EQ(velocity, 0.0);
}

TEST(CyclicRideThrough, AfterAFaultItStartsFromWhereItIs) {
  CyclicHost host(stiff_cyclic());
  host.prepare();
  for (int n = 0; n < 20; ++n) host.cycle(n, kStep * n);
  host.run(ms(200));
  const auto actual = static_cast<std::int32_t>(host.read(0x6064, 0));
  host.control(0x80);
  EXPECT_EQ(host.status(), 0x0340U);
  EXPECT_EQ(host.read(0x603F, 0), 0U);
  host.control(0x06);
  host.control(0x0F);
  host.samples.clear();
  host.seen.clear();
  host.start = host.world.now();
  for (int n = 0; n < 10; ++n) host.cycle(n, actual);
  for (const CyclicSample& sample : host.samples) EXPECT_NEAR(sample.demand, actual, 0.5);
  EXPECT_EQ(host.read(0x2100, 3), 0U);
  EXPECT_EQ(host.status(), 0x1337U);
}

TEST(CyclicRideThrough, LimitZeroMeansNoExtrapolation) {
  CyclicHost host(stiff_cyclic());
  host.prepare();
  ASSERT_EQ(host.write(0x2100, 2, 0, 1), 0U);
  host.start = host.world.now();
  for (int n = 0; n < 5; ++n) host.cycle(n, kStep * n);
  host.run(ms(25));
  const auto emergency = host.take(0x081);
  ASSERT_TRUE(emergency);
  EXPECT_NEAR(ms_between(host.sync_arrival(4), emergency->time), 10.7, 0.7);
}

// Target 1000 comes 4 ms after its SYNC was due, event-driven or by a late SYNC: it is taken at once. Order
// 1, gain 1/8: a straight line from when it was due, reached half a millisecond later than a punctual one.
TEST(CyclicRideThrough, LateTargetIsAppliedAtOnce) {
  for (const bool late_sync : {true, false}) {
    CyclicHost host(stiff_cyclic());
    host.boot();
    ASSERT_EQ(host.write(0x2100, 1, 1, 1), 0U);
    if (!late_sync) {
      ASSERT_EQ(host.write(0x1400, 2, 255, 1), 0U);
    }
    host.prepare();
    const auto punctual = [&](int n) {
      host.run_to(host.sync_time(n) - ms(late_sync ? 5 : 0));
      host.target(0);
      host.run_to(host.sync_time(n));
      if (late_sync) host.sync();
    };
    for (int n = 0; n < 5; ++n) punctual(n);
    host.run_to(host.sync_time(5) - ms(5));
    if (late_sync) host.target(1000);
    host.run_to(host.sync_time(5) + ms(4));
    late_sync ? host.sync() : host.target(1000);
    host.run(ms(6.8));
    const HostTime due = host.sync_time(5);
    int moved = 0;
    for (const CyclicSample& sample : host.samples) {
      const double after = ms_between(due, sample.time);
      if (after <= 4.0) {
        EXPECT_EQ(sample.demand, 0.0) << after;
      }
      // An RPDO of 6 bytes takes up to 0.12 ms, SYNC 0.05 ms; the line moves with them.
      if (after > 4.2) {
        EXPECT_NEAR(sample.demand, 1000.0 * after / 10.5, 15.0) << after;
        ++moved;
      }
    }
    EXPECT_GE(moved, 6);
    EXPECT_EQ(host.cyclic->counters().updates, 6U);
    EXPECT_EQ(host.read(0x2100, 3), 0U);
  }
}

// The drive's crystal is 500 ppm fast: each SYNC seems 5 us late, so the grid trails by 5 us / gain = 40 us,
// 0.4 counts, and no more after half a minute.
TEST(CyclicRideThrough, ItsGridFollowsTheHostsClock) {
  CyclicParameters parameters = stiff_cyclic();
  parameters.clock_error_ppm = 500.0;
  CyclicHost host(parameters);
  host.prepare();
  for (int n = 0; n < 3000; ++n) host.cycle(n, kStep * n);
  double worst = 0.0;
  for (const CyclicSample& sample : host.samples) {
    if (sample.time < host.sync_arrival(300)) continue;
    worst = std::max(worst, std::abs(sample.demand - ramp_demand(host, sample.time)));
  }
  EXPECT_LT(worst, 0.5);
  EXPECT_GT(worst, 0.2);
  EXPECT_EQ(host.read(0x2100, 3), 0U);
}

double worst_velocity_error(double gain) {
  CyclicParameters parameters = stiff_cyclic();
  parameters.sync_gain = gain;
  CyclicHost host(parameters);
  host.prepare();
  std::mt19937_64 engine(5);
  for (int n = 0; n < 300; ++n) host.cycle(n, kStep * n, static_cast<double>(engine() % 2000) * 1e-3);
  double worst = 0.0;
  for (const CyclicSample& sample : host.samples) {
    if (sample.time > host.sync_arrival(20)) worst = std::max(worst, std::abs(sample.velocity - 10000.0));
  }
  return worst;
}

// SYNC comes 0..2 ms late. Unfiltered, neighbouring updates seem 8..12 ms apart.
TEST(CyclicRideThrough, JitterOfSyncDoesNotShakeTheMotion) {
  const double unfiltered = worst_velocity_error(1.0);
  const double filtered = worst_velocity_error(0.125);
  EXPECT_GT(unfiltered, 2000.0);
  EXPECT_LT(filtered, unfiltered / 3);
}

}  // namespace
}  // namespace interpolated_motion::emulation
