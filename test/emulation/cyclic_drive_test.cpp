#include "interpolated_motion_driver/emulation/cyclic_drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>

#include "cyclic_host.h"

namespace interpolated_motion::emulation {
namespace {

double ms_between(HostTime from, HostTime to) { return seconds(to - from) * 1e3; }

/// Constant velocity of 10 counts/ms, which every order extrapolates exactly.
constexpr int kStep = 100;

/// Demand of that motion: target 100 n takes effect at SYNC n and is reached a period later.
double ramp_demand(const CyclicHost& host, HostTime time) {
  return 10.0 * ms_between(host.sync_arrival(1), time);
}

TEST(CyclicDrive, ComesUpAsAServoDriveOfItsOwn) {
  CyclicHost host;
  host.run(ms(205));
  EXPECT_EQ(host.count(0x701), 1U);
  EXPECT_EQ(host.read(0x1000, 0), 0x00020192U);
  EXPECT_EQ(host.read(0x1018, 1), 0U);
  EXPECT_EQ(host.read(0x1018, 2), 0x43535038U);
  EXPECT_EQ(host.read(0x6502, 0), 0x80U) << "bit 7: cyclic synchronous position";
  EXPECT_EQ(host.status(), 0x0140U);
  EXPECT_EQ(host.write(0x6060, 0, 7, 1), 0x06090030U);
  EXPECT_EQ(host.write(0x6060, 0, 8, 1), 0U);
  EXPECT_EQ(host.read(0x6061, 0), 8U);
  EXPECT_EQ(host.write(0x60C2, 1, 21, 1), 0x06090031U);
  host.nmt(1);
  host.control(0x06);
  EXPECT_EQ(host.status(), 0x0321U);
  host.control(0x0F);
  EXPECT_EQ(host.status(), 0x0337U) << "nothing to follow yet";
  host.start = host.world.now();
  host.cycle(0, 0);
  host.run(ms(2));
  EXPECT_EQ(host.status(), 0x1337U) << "bit 12: follows the command";
  EXPECT_EQ(host.count(0x181), 1U) << "TPDO1 answers SYNC";
  EXPECT_EQ(host.count(0x081), 0U);
}

// Between SYNCs the demand is the motion the targets come from, one period and one SYNC frame later. What is
// left is the rounding of the targets, 1/2 count times 1.632 (Lebesgue constant of four equidistant nodes,
// taken in the outer interval), and the remainder |f''''| / 24 max |x (x - T) (x + T) (x + 2 T)|, which is
// T^4 there.
TEST(CyclicDrive, FollowsASineAtTenMillisecondSync) {
  CyclicHost host(stiff_cyclic());
  host.prepare();
  constexpr double kOmega = 6.283185307179586 * 0.5;
  constexpr double kAmplitude = 50000.0;
  const auto f = [](double t_ms) { return kAmplitude * (1 - std::cos(kOmega * t_ms * 1e-3)); };
  for (int n = 0; n < 400; ++n) host.cycle(n, static_cast<std::int32_t>(std::lround(f(10.0 * n))));
  host.run(ms(1));
  const double bound = 0.5 * 1.632 + kAmplitude * std::pow(kOmega * 0.010, 4) / 24;
  double worst = 0.0;
  for (const CyclicSample& sample : host.samples) {
    if (sample.time < host.sync_arrival(4)) continue;  // the rest before the motion is no part of the sine
    const double expected = f(ms_between(host.sync_arrival(1), sample.time));
    worst = std::max(worst, std::abs(sample.demand - expected));
    EXPECT_EQ(sample.missed, 0U);
  }
  EXPECT_GT(host.samples.size(), 3900U);
  EXPECT_LE(worst, bound);
  EXPECT_GT(worst, 0.5 * bound);
  EXPECT_EQ(host.cyclic->counters().updates, 400U);
}

TEST(CyclicDrive, LostSyncsAndLostTargetsAreRiddenThrough) {
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
TEST(CyclicDrive, BeyondTheLimitItFaultsAndBrakes) {
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

TEST(CyclicDrive, AfterAFaultItStartsFromWhereItIs) {
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

TEST(CyclicDrive, LimitZeroMeansNoExtrapolation) {
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
TEST(CyclicDrive, LateTargetIsAppliedAtOnce) {
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
TEST(CyclicDrive, ItsGridFollowsTheHostsClock) {
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
TEST(CyclicDrive, JitterOfSyncDoesNotShakeTheMotion) {
  const double unfiltered = worst_velocity_error(1.0);
  const double filtered = worst_velocity_error(0.125);
  EXPECT_GT(unfiltered, 2000.0);
  EXPECT_LT(filtered, unfiltered / 3);
}

TEST(CyclicDrive, TargetFarAwayIsAFollowingError) {
  CyclicHost host;
  host.prepare();
  for (int n = 0; n < 4; ++n) host.cycle(n, 100000);
  const auto emergency = host.take(0x081);
  ASSERT_TRUE(emergency);
  EXPECT_EQ(bytes_of(emergency->frame), (Bytes{0x11, 0x86, 0x21, 0, 0, 0, 0, 0}));
}

TEST(CyclicDrive, ActualPositionLagsByTheSetTime) {
  CyclicParameters parameters;
  parameters.plant.lag_ms = 3.0;
  parameters.servo_period = std::chrono::microseconds(500);
  CyclicHost host(parameters);
  host.prepare();
  for (int n = 0; n < 40; ++n) host.cycle(n, kStep * n);
  EXPECT_NEAR(host.samples.back().demand - host.samples.back().actual, 30.0, 0.51);
  EXPECT_EQ(host.samples.size(), 800U) << "two a millisecond";
  EXPECT_EQ(static_cast<std::int32_t>(host.read(0x60F4, 0)), 30);
}

// Mode 0 brakes on 0x6084: 10 counts/ms at 1 count/ms^2 take 10 ms and 50 counts.
TEST(CyclicDrive, LeavingTheModeBrakesAndEnteringStartsThere) {
  CyclicHost host(stiff_cyclic());
  host.prepare();
  for (int n = 0; n < 10; ++n) host.cycle(n, kStep * n);
  ASSERT_EQ(host.write(0x6060, 0, 0, 1), 0U);
  const auto last = std::find_if(host.samples.rbegin(), host.samples.rend(),
                                 [](const CyclicSample& s) { return s.following; });
  const double left_at = last->demand;
  EXPECT_EQ(host.status(), 0x0337U);
  host.run(ms(50));
  const auto actual = static_cast<std::int32_t>(host.read(0x6064, 0));
  EXPECT_NEAR(actual, left_at + 50.0, 0.51);
  ASSERT_EQ(host.write(0x6060, 0, 8, 1), 0U);
  host.start = host.world.now();
  host.samples.clear();
  for (int n = 0; n < 5; ++n) host.cycle(n, actual);
  for (const CyclicSample& sample : host.samples) EXPECT_NEAR(sample.demand, actual, 0.51);
  EXPECT_EQ(host.status(), 0x1337U);
}

TEST(CyclicDrive, LostHeartbeatOfTheHostIsAFault) {
  CyclicHost host(stiff_cyclic());
  host.boot();
  ASSERT_EQ(host.write(0x1016, 1, 0x007F0032, 4), 0U);  // node 127 within 50 ms
  ASSERT_EQ(host.write(0x1017, 0, 20, 2), 0U);
  host.prepare();
  host.send(0x77F, {5});
  host.run(ms(45));
  EXPECT_EQ(host.count(0x081), 0U);
  EXPECT_GE(host.count(0x701), 2U);
  host.run(ms(10));
  EXPECT_EQ(host.count(0x081), 1U);
  EXPECT_EQ(host.status(), 0x0308U);
}

TEST(CyclicDrive, PowerCycleAndSilence) {
  CyclicHost host(stiff_cyclic());
  host.prepare();
  for (int n = 0; n < 20; ++n) host.cycle(n, kStep * n);
  const std::int32_t before = host.cyclic->position();
  EXPECT_GT(before, 1000);
  host.cyclic->power_cycle(host.world.now(), ms(100));
  EXPECT_TRUE(host.exchange({0x40, 0x41, 0x60, 0}).empty());
  host.run(ms(400));
  EXPECT_EQ(host.status(), 0x0140U);
  EXPECT_EQ(host.read(0x6061, 0), 0U);
  EXPECT_NEAR(static_cast<std::int32_t>(host.read(0x6064, 0)), before, 1);
  host.cyclic->silence(true, host.world.now());
  EXPECT_TRUE(host.exchange({0x40, 0x41, 0x60, 0}).empty());
  host.cyclic->silence(false, host.world.now());
  EXPECT_EQ(host.status(), 0x0140U);
}

/// A drive in motion among frames of any kind; everything it says, with times.
std::string trace_among_garbage(std::uint64_t seed) {
  CyclicHost host;
  host.prepare();
  std::mt19937_64 random(seed);
  const std::uint32_t ids[] = {0x000, 0x080, 0x201, 0x301, 0x401, 0x501, 0x181, 0x281, 0x601, 0x701, 0x77F};
  for (int i = 0; i < 300; ++i) {
    canopen::Frame frame;
    frame.id = random() % 8 == 0 ? static_cast<std::uint32_t>(random() % 0x800) : ids[random() % 11];
    frame.remote = random() % 16 == 0;
    frame.length = static_cast<std::uint8_t>(random() % 9);
    const std::uint64_t data = random();
    for (std::size_t k = 0; k < 8; ++k) frame.data[k] = static_cast<std::uint8_t>(data >> (8 * k));
    if (random() % 2 == 0) frame.data[0] = static_cast<std::uint8_t>(random() % 2 == 0 ? 0x23 : 0x0F);
    if (random() % 4 == 0) frame.length = frame.id == 0 ? 2 : 8;
    host.send(frame);
    host.run(ms(random() % 4 == 0 ? 1.0 : 0.2));
  }
  host.send(0x000, {129, 0});
  host.run(ms(250));
  EXPECT_EQ(host.status(), 0x0140U) << "seed " << seed << ": the drive must answer after a reset";
  std::string text;
  for (const auto& f : host.seen) {
    text += std::to_string(f.time.time_since_epoch().count()) + ':' + std::to_string(f.frame.id) + '#';
    for (const std::uint8_t byte : bytes_of(f.frame)) text += std::to_string(byte) + ',';
  }
  return text;
}

TEST(CyclicDrive, GarbageFramesDoNoHarmAndRunsRepeatExactly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string first = trace_among_garbage(seed);
    EXPECT_GT(first.size(), 100U);
    EXPECT_EQ(first, trace_among_garbage(seed)) << "seed " << seed;
  }
}

TEST(CyclicDrive, SharesABusWithAnEpos) {
  World world;
  auto& bus = world.add_can_bus("can0", 1'000'000);
  world.add_epos(bus, EposParameters{});
  CyclicParameters parameters;
  EXPECT_THROW(world.add_cyclic(bus, parameters), std::invalid_argument) << "node id 1 is taken";
  parameters.node_id = 2;
  world.add_cyclic(bus, parameters);
  parameters.node_id = 3;
  parameters.sync_gain = 0.0;
  try {
    world.add_cyclic(bus, parameters);
    FAIL() << "sync_gain 0 was taken";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_EQ(std::string(refusal.what()),
              "emulated drive with node id 3: sync_gain is 0, allowed is above 0 to 1");
  }
}

}  // namespace
}  // namespace interpolated_motion::emulation
