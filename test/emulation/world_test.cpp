#include "interpolated_motion_driver/emulation/world.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulation/canopen/wire_host.h"

namespace interpolated_motion::emulation {
namespace {

int property_cases(int fallback) {
  const char* text = std::getenv("IMD_PROPERTY_CASES");
  return text != nullptr ? std::atoi(text) : fallback;
}

TEST(World, AdvanceStopsAtTheFirstFrameForTheHost) {
  World world;
  auto& bus = world.add_can_bus("can0", 1'000'000);
  world.add<EposDrive>(bus, EposParameters{});
  const HostTime limit = HostTime{} + ms(1000);
  const HostTime boot = world.advance(limit);
  EXPECT_LT(boot, HostTime{} + ms(200.1));
  EXPECT_EQ(world.now(), boot);
  const auto frame = world.can_bus("can0").receive();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->frame.id, 0x701U);
  EXPECT_EQ(frame->time, boot);
  EXPECT_EQ(world.advance(limit), limit);
}

TEST(World, UnreadFramesDoNotHoldTimeUp) {
  World world;
  auto& bus = world.add_can_bus("can0", 1'000'000);
  world.add<EposDrive>(bus, EposParameters{});
  const HostTime limit = HostTime{} + ms(1000);
  world.advance(limit);
  EXPECT_EQ(world.advance(limit), limit);
  EXPECT_TRUE(world.can_bus("can0").receive());
}

TEST(World, AFrameWithALaterTimeStampLeavesThen) {
  WireHost host;
  host.boot();
  const HostTime later = host.world.now() + ms(5);
  ASSERT_TRUE(host.world.can_bus("can0").send(make_frame(0x080, {}), later));
  const HostTime seen = host.world.advance(later + ms(10));
  // SYNC has 51 bits, 48 of them before the interframe space.
  EXPECT_EQ(seen, later + std::chrono::microseconds(48));
}

TEST(World, BusesAreSeparate) {
  World world;
  auto& a = world.add_can_bus("a", 1'000'000);
  auto& b = world.add_can_bus("b", 250'000);
  world.add<EposDrive>(a, EposParameters{});
  world.add<EposDrive>(b, EposParameters{});
  for (int i = 0; i < 4; ++i) world.advance(HostTime{} + ms(500));
  EXPECT_TRUE(world.can_bus("a").receive());
  EXPECT_FALSE(world.can_bus("a").receive());
  EXPECT_TRUE(world.can_bus("b").receive());
}

TEST(World, RefusesWrongSettingsByName) {
  World world;
  auto& bus = world.add_can_bus("can0", 1'000'000);
  EXPECT_THROW(world.add_can_bus("can0", 1'000'000), std::invalid_argument);
  EXPECT_THROW(world.can_bus("can1"), std::invalid_argument);
  EposParameters parameters;
  world.add<EposDrive>(bus, parameters);
  EXPECT_THROW(world.add<EposDrive>(bus, parameters), std::invalid_argument);
  parameters.node_id = 128;
  try {
    world.add<EposDrive>(bus, parameters);
    FAIL() << "node id 128 was taken";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_EQ(std::string(refusal.what()),
              "emulated drive with node id 128: node_id is 128, allowed is 1..127");
  }
}

TEST(World, PowerCycleSilenceAndLoad) {
  WireHost host;
  host.prepare();
  host.drive->power_cycle(host.world.now(), ms(100));
  EXPECT_TRUE(host.exchange({0x40, 0x41, 0x60, 0}).empty());
  host.seen.clear();
  host.run(ms(400));
  EXPECT_EQ(host.count(0x701), 1U);
  EXPECT_EQ(host.status(), 0x0140U);
  host.drive->silence(true, host.world.now());
  EXPECT_TRUE(host.exchange({0x40, 0x41, 0x60, 0}).empty());
  host.drive->silence(false, host.world.now());
  host.run(ms(10));
  EXPECT_EQ(host.status(), 0x0140U);
  host.prepare();
  host.drive->set_load(25.0);
  host.run(ms(100));
  EXPECT_EQ(host.read(0x6064, 0), 25U);
  EXPECT_EQ(static_cast<std::int16_t>(host.read(0x20F4, 0)), -25);
}

std::string trace(std::uint64_t seed, int frames) {
  WireHost host;
  EposParameters second;
  second.node_id = 2;
  second.clock_error_ppm = 80.0;
  host.world.add<EposDrive>(host.bus, second);
  host.boot();
  std::mt19937_64 random(seed);
  const std::uint32_t ids[] = {0x000, 0x080, 0x201, 0x301, 0x302, 0x401, 0x501, 0x601, 0x602, 0x701, 0x77F};
  for (int i = 0; i < frames; ++i) {
    canopen::Frame frame;
    frame.id = random() % 8 == 0 ? static_cast<std::uint32_t>(random() % 0x800) : ids[random() % 11];
    frame.remote = random() % 16 == 0;
    frame.length = static_cast<std::uint8_t>(random() % 9);
    const std::uint64_t data = random();
    for (std::size_t k = 0; k < 8; ++k) frame.data[k] = static_cast<std::uint8_t>(data >> (8 * k));
    if (random() % 2 == 0) frame.data[0] = static_cast<std::uint8_t>(random() % 2 == 0 ? 0x23 : 0x40);
    if (random() % 4 == 0) frame.length = frame.id == 0 ? 2 : 8;
    host.send(frame);
    host.run(ms(random() % 4 == 0 ? 1.0 : 0.2));
  }
  host.send(0x000, {129, 0});
  host.run(ms(250));
  EXPECT_EQ(host.status() & 0x417FU, 0x0140U) << "seed " << seed << ": the drive must answer after a reset";
  std::string text;
  for (const auto& f : host.seen) {
    text += std::to_string(f.time.time_since_epoch().count()) + ':' + std::to_string(f.frame.id) + '#';
    for (const std::uint8_t byte : bytes_of(f.frame)) text += std::to_string(byte) + ',';
  }
  return text;
}

TEST(World, GarbageFramesDoNoHarmAndRunsRepeatExactly) {
  const int cases = property_cases(20);
  for (int seed = 1; seed <= cases; ++seed) {
    const std::string first = trace(static_cast<std::uint64_t>(seed), 300);
    EXPECT_GT(first.size(), 100U);
    if (seed <= 3) {
      EXPECT_EQ(first, trace(static_cast<std::uint64_t>(seed), 300)) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace interpolated_motion::emulation
