#include <gtest/gtest.h>

#include "wire_host.h"

// NMT, error control and EMCY of CiA 301 at the wire.
namespace interpolated_motion::emulation {
namespace {

TEST(Nmt, BootUpMessageAfterTheBootTimeThenPreOperational) {
  EposParameters parameters;
  parameters.node_id = 5;
  parameters.boot_time = ms(150);
  WireHost host(parameters);
  host.run(ms(149.9));
  EXPECT_TRUE(host.seen.empty());
  host.run(ms(1));
  ASSERT_EQ(host.seen.size(), 1U);
  EXPECT_EQ(host.seen[0].frame.id, 0x705U);
  EXPECT_EQ(bytes_of(host.seen[0].frame), Bytes{0});
  // One byte: 52 .. 62 bits from the start of frame to the end of frame.
  EXPECT_GE(host.seen[0].time, HostTime{} + ms(150.052));
  EXPECT_LE(host.seen[0].time, HostTime{} + ms(150.062));
  EXPECT_EQ(host.status(), 0x0140U) << "not remote: not Operational";
}

TEST(Nmt, HeartbeatTellsTheStateAtTheSetPeriod) {
  WireHost host;
  host.boot();
  ASSERT_EQ(host.write(0x1017, 0, 10, 2), 0U);
  host.run(ms(3));
  EXPECT_EQ(bytes_of(host.take(0x701)->frame), Bytes{0x7F});
  host.nmt(1);
  EXPECT_EQ(host.status(), 0x0340U);
  host.run(ms(20));
  const auto first = host.take(0x701);
  const auto second = host.take(0x701);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(bytes_of(first->frame), Bytes{0x05});
  EXPECT_NEAR(seconds(second->time - first->time), 0.010, 1e-7);
  host.nmt(2);
  host.seen.clear();
  host.run(ms(20));
  EXPECT_EQ(bytes_of(host.take(0x701)->frame), Bytes{0x04});
  host.send(0x000, {128, 0});
  host.run(ms(1));
  host.seen.clear();
  host.run(ms(20));
  EXPECT_EQ(bytes_of(host.take(0x701)->frame), Bytes{0x7F}) << "id 0 addresses all";
}

TEST(Nmt, CommandsForOthersAndUnknownOnesAreIgnored) {
  WireHost host;
  host.boot();
  host.send(0x000, {1, 2});
  host.send(0x000, {77, 1});
  host.send(0x000, {1});
  EXPECT_EQ(host.status(), 0x0140U);
}

TEST(Nmt, ResetNodeLosesVolatileStateAndKeepsThePosition) {
  EposParameters parameters;
  parameters.initial_position = 4321;
  WireHost host(parameters);
  host.prepare();
  ASSERT_EQ(host.write(0x6065, 0, 77, 4), 0U);
  host.nmt(129);
  EXPECT_TRUE(host.exchange({0x40, 0x41, 0x60, 0}).empty()) << "the drive is away while it boots";
  host.run(ms(250));
  EXPECT_EQ(host.count(0x701), 1U);
  EXPECT_EQ(host.status(), 0x0140U);
  EXPECT_EQ(host.read(0x6065, 0), 2000U);
  EXPECT_EQ(host.read(0x6061, 0), 1U);
  EXPECT_EQ(host.read(0x60C4, 4), 0U);
  EXPECT_EQ(host.read(0x1600, 1), 0x60400010U);
  EXPECT_EQ(host.read(0x6064, 0), 4321U);
}

TEST(Nmt, ResetCommunicationRestoresTheCommunicationObjectsOnly) {
  WireHost host;
  host.boot();
  ASSERT_EQ(host.write(0x1017, 0, 1000, 2), 0U);
  ASSERT_EQ(host.write(0x6065, 0, 77, 4), 0U);
  host.seen.clear();
  host.nmt(130);
  host.run(ms(5));
  ASSERT_EQ(host.count(0x701), 1U);
  EXPECT_EQ(bytes_of(host.take(0x701)->frame), Bytes{0});
  EXPECT_EQ(host.read(0x1017, 0), 0U);
  EXPECT_EQ(host.read(0x6065, 0), 77U);
}

// 0x6007: 0 nothing, 1 fault, 2 disable voltage, 3 quick stop.
TEST(Nmt, LossOfAWatchedHeartbeatReactsByTheOptionCode) {
  const std::uint32_t expected[] = {0x0737, 0x0308, 0x0340, 0x0317};
  for (unsigned option = 0; option <= 3; ++option) {
    SCOPED_TRACE(option);
    WireHost host;
    host.prepare();
    ASSERT_EQ(host.write(0x6007, 0, option, 2), 0U);
    ASSERT_EQ(host.write(0x1016, 1, 0x007F0032, 4), 0U);  // node 127, 50 ms
    host.run(ms(200));
    EXPECT_EQ(host.count(0x081), 0U) << "watching begins with the first heartbeat";
    host.send(0x77F, {5});
    host.run(ms(40));
    host.send(0x77F, {5});
    const HostTime last = host.world.now();
    host.run(ms(100));
    const auto emergency = host.take(0x081);
    ASSERT_TRUE(emergency);
    EXPECT_EQ(bytes_of(emergency->frame), (Bytes{0x30, 0x81, 0x11, 0, 0, 0, 0, 0}));
    EXPECT_GE(seconds(emergency->time - last), 0.050);
    EXPECT_LE(seconds(emergency->time - last), 0.052);
    EXPECT_EQ(host.status(), expected[option]);
    EXPECT_EQ(host.count(0x081), 0U) << "reported once";
  }
}

TEST(Nmt, GuardingTogglesAndItsLossIsAnError) {
  WireHost host;
  host.boot();
  ASSERT_EQ(host.write(0x100C, 0, 10, 2), 0U);
  ASSERT_EQ(host.write(0x100D, 0, 3, 1), 0U);
  for (const unsigned answer : {0x7FU, 0xFFU, 0x7FU}) {
    host.send(make_remote(0x701, 1));
    host.run(ms(20));
    EXPECT_EQ(bytes_of(host.take(0x701)->frame), Bytes{static_cast<std::uint8_t>(answer)});
  }
  EXPECT_EQ(host.count(0x081), 0U);
  host.run(ms(20));
  EXPECT_EQ(host.count(0x081), 1U);
}

TEST(Emergency, HistoryKeepsTheLastFiveNewestFirst) {
  WireHost host;
  host.boot();
  for (unsigned i = 1; i <= 6; ++i) {
    host.drive->send_emergency(static_cast<std::uint16_t>(0xFF00 + i), 0x20, host.world.now());
  }
  host.run(ms(5));
  EXPECT_EQ(host.count(0x081), 6U);
  EXPECT_EQ(host.read(0x1003, 0), 5U);
  for (unsigned i = 1; i <= 5; ++i) EXPECT_EQ(host.read(0x1003, i), 0xFF07U - i);
  EXPECT_EQ(host.write(0x1003, 0, 1, 1), 0x06090030U);
  ASSERT_EQ(host.write(0x1003, 0, 0, 1), 0U);
  EXPECT_EQ(host.read(0x1003, 0), 0U);
  EXPECT_EQ(host.read(0x1003, 1), 0U);
}

TEST(Emergency, InjectedFaultDisablesTheDrive) {
  WireHost host;
  host.prepare();
  host.drive->raise_fault(0x2310, 0x02, host.world.now());
  host.run(ms(5));
  EXPECT_EQ(bytes_of(host.take(0x081)->frame), (Bytes{0x10, 0x23, 0x03, 0, 0, 0, 0, 0}));
  EXPECT_EQ(host.status(), 0x0308U);
}

TEST(Emergency, NothingIsSentWhileStopped) {
  WireHost host;
  host.boot();
  host.nmt(2);
  host.drive->send_emergency(0x1000, 0, host.world.now());
  host.run(ms(5));
  EXPECT_EQ(host.count(0x081), 0U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
