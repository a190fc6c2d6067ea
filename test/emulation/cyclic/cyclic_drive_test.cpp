#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"

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
  world.add<EposDrive>(bus, EposParameters{});
  CyclicParameters parameters;
  EXPECT_THROW(world.add<CyclicDrive>(bus, parameters), std::invalid_argument) << "node id 1 is taken";
  parameters.node_id = 2;
  world.add<CyclicDrive>(bus, parameters);
  parameters.node_id = 3;
  parameters.sync_gain = 0.0;
  try {
    world.add<CyclicDrive>(bus, parameters);
    FAIL() << "sync_gain 0 was taken";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_EQ(std::string(refusal.what()),
              "emulated drive with node id 3: sync_gain is 0, allowed is above 0 to 1");
  }
}

}  // namespace
}  // namespace interpolated_motion::emulation
