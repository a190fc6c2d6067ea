#include "interpolated_motion_driver/transport/virtual_can_bus.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "interpolated_motion_driver/transport/can_frame_bits.h"

namespace interpolated_motion::transport {
namespace {

struct Listener : CanListener {
  std::vector<canopen::ReceivedFrame> seen;
  void on_can_frame(const canopen::Frame& frame, HostTime time) override {
    seen.push_back({frame, time, false});
  }
};

canopen::Frame frame(std::uint32_t id, std::uint8_t first = 0, std::uint8_t length = 8) {
  canopen::Frame result;
  result.id = id;
  result.length = length;
  result.data[0] = first;
  return result;
}

HostTime at_us(std::int64_t us) { return HostTime{} + std::chrono::microseconds(us); }

struct VirtualCanBusTest : testing::Test {
  VirtualCanBus bus{"can0", 1'000'000};
  Listener a;
  Listener b;
  int port_a = bus.add_port(a);
  int port_b = bus.add_port(b);

  std::vector<std::uint32_t> ids(const Listener& listener) const {
    std::vector<std::uint32_t> result;
    for (const auto& f : listener.seen) result.push_back(f.frame.id);
    return result;
  }
};

// The all-zero record on 0x201 has 125 bits, 3 of them interframe space: its last bit is 122 us after its
// first, and the next frame ends 125 us later.
TEST_F(VirtualCanBusTest, FramesTakeTheirBitTimes) {
  ASSERT_TRUE(bus.host().send(frame(0x201), at_us(1000)));
  ASSERT_TRUE(bus.host().send(frame(0x201), at_us(1000)));
  bus.process(at_us(2000));
  ASSERT_EQ(a.seen.size(), 2U);
  EXPECT_EQ(a.seen[0].time, at_us(1122));
  EXPECT_EQ(a.seen[1].time, at_us(1247));
  EXPECT_EQ(bus.statistics().bits, 250U);
  EXPECT_EQ(bus.statistics().frames, 2U);
}

TEST_F(VirtualCanBusTest, AnInstantaneousBusTakesNoTimeAndStillArbitrates) {
  bus.set_instantaneous(true);
  ASSERT_TRUE(bus.send(port_a, frame(0x300), at_us(1000)));
  ASSERT_TRUE(bus.host().send(frame(0x202), at_us(1000)));
  ASSERT_TRUE(bus.host().send(frame(0x201), at_us(1000)));
  bus.process(at_us(1000));
  EXPECT_EQ(ids(b), (std::vector<std::uint32_t>{0x202, 0x201, 0x300}));
  for (const auto& f : b.seen) EXPECT_EQ(f.time, at_us(1000));
}

TEST_F(VirtualCanBusTest, HalfTheBitrateTakesTwiceTheTime) {
  VirtualCanBus slow("can1", 500'000);
  Listener c;
  slow.add_port(c);
  slow.host().send(frame(0x201), at_us(0));
  slow.process(at_us(1000));
  ASSERT_EQ(c.seen.size(), 1U);
  EXPECT_EQ(c.seen[0].time, at_us(244));
}

TEST_F(VirtualCanBusTest, LowestIdentifierAmongTheHeadsWins) {
  bus.host().send(frame(0x300), at_us(0));
  bus.host().send(frame(0x001), at_us(0));  // behind 0x300 in the same queue
  bus.send(port_a, frame(0x200), at_us(0));
  bus.send(port_a, frame(0x181), at_us(0));
  bus.process(at_us(10'000));
  EXPECT_EQ(ids(b), (std::vector<std::uint32_t>{0x200, 0x181, 0x300, 0x001}));
}

TEST_F(VirtualCanBusTest, AFrameOnTheBusIsNotInterrupted) {
  bus.host().send(frame(0x700), at_us(0));
  bus.process(at_us(50));
  bus.send(port_a, frame(0x001), at_us(50));
  bus.process(at_us(10'000));
  EXPECT_EQ(ids(b), (std::vector<std::uint32_t>{0x700, 0x001}));
}

TEST_F(VirtualCanBusTest, DataFrameWinsAgainstRemoteFrame) {
  canopen::Frame remote = frame(0x181, 0, 2);
  remote.remote = true;
  bus.host().send(remote, at_us(0));
  bus.send(port_a, frame(0x181, 5, 2), at_us(0));
  bus.process(at_us(1000));
  ASSERT_EQ(b.seen.size(), 2U);
  EXPECT_FALSE(b.seen[0].frame.remote);
  EXPECT_TRUE(b.seen[1].frame.remote);
}

TEST_F(VirtualCanBusTest, HostSeesOthersAndItsOwnConfirmations) {
  bus.host().send(frame(0x201), at_us(0));
  bus.send(port_a, frame(0x181), at_us(0));
  EXPECT_FALSE(bus.host().receive()) << "nothing is confirmed before it was on the bus";
  bus.process(at_us(1000));
  const auto first = bus.host().receive();
  const auto second = bus.host().receive();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->frame.id, 0x181U);
  EXPECT_FALSE(first->own);
  EXPECT_EQ(second->frame.id, 0x201U);
  EXPECT_TRUE(second->own);
  EXPECT_FALSE(bus.host().receive());
  EXPECT_EQ(ids(a), (std::vector<std::uint32_t>{0x201})) << "a node does not hear itself";
}

TEST_F(VirtualCanBusTest, QueuesAreFinite) {
  for (std::size_t i = 0; i < VirtualCanBus::kHostQueue; ++i) {
    ASSERT_TRUE(bus.host().send(frame(0x201), at_us(0)));
  }
  EXPECT_FALSE(bus.host().send(frame(0x201), at_us(0)));
  for (std::size_t i = 0; i < VirtualCanBus::kDriveQueue; ++i)
    ASSERT_TRUE(bus.send(port_a, frame(0x300), at_us(0)));
  EXPECT_FALSE(bus.send(port_a, frame(0x300), at_us(0)));
  EXPECT_EQ(bus.free_slots(port_a), 0U);
  bus.process(at_us(125));
  EXPECT_TRUE(bus.host().send(frame(0x201), at_us(125))) << "the first frame has left";
}

TEST_F(VirtualCanBusTest, DroppedFramesTakeTimeAndReachNobody) {
  bus.drop_next(1);
  for (int i = 0; i < 3; ++i) bus.host().send(frame(0x201), at_us(0));
  bus.process(at_us(1000));
  ASSERT_EQ(a.seen.size(), 2U);
  EXPECT_EQ(a.seen[0].time, at_us(247));
  EXPECT_EQ(bus.statistics().lost, 1U);
  bus.drop_if([](const canopen::Frame& f) { return f.id == 0x202; });
  bus.host().send(frame(0x202), at_us(1000));
  bus.host().send(frame(0x203), at_us(1000));
  bus.process(at_us(2000));
  EXPECT_EQ(ids(a), (std::vector<std::uint32_t>{0x201, 0x201, 0x203}));
}

TEST_F(VirtualCanBusTest, TamperedFramesArriveChanged) {
  bus.tamper([](canopen::Frame& f) { f.data[0] ^= 0xFF; });
  bus.host().send(frame(0x201, 0x0F), at_us(0));
  bus.process(at_us(1000));
  ASSERT_EQ(a.seen.size(), 1U);
  EXPECT_EQ(a.seen[0].frame.data[0], 0xF0);
  EXPECT_EQ(bus.host().receive()->frame.data[0], 0x0F) << "the sender believes what it sent";
}

TEST_F(VirtualCanBusTest, WithoutAReceiverFramesStayQueued) {
  bus.connect(port_a, false, at_us(0));
  bus.connect(port_b, false, at_us(0));
  ASSERT_TRUE(bus.host().send(frame(0x201), at_us(0)));
  EXPECT_FALSE(bus.send(port_a, frame(0x181), at_us(0)));
  bus.process(at_us(5000));
  EXPECT_EQ(bus.statistics().frames, 0U);
  EXPECT_EQ(bus.next_event(), kNever);
  bus.connect(port_b, true, at_us(5000));
  bus.process(at_us(6000));
  ASSERT_EQ(b.seen.size(), 1U);
  EXPECT_EQ(b.seen[0].time, at_us(5122));
  EXPECT_TRUE(a.seen.empty());
}

TEST_F(VirtualCanBusTest, UnpluggedHostKeepsItsQueueAndHearsNothing) {
  bus.connect(0, false, at_us(0));
  ASSERT_TRUE(bus.host().send(frame(0x201), at_us(0)));
  bus.send(port_a, frame(0x181), at_us(0));
  bus.process(at_us(1000));
  EXPECT_FALSE(bus.host().receive());
  EXPECT_EQ(ids(b), (std::vector<std::uint32_t>{0x181}));
  bus.connect(0, true, at_us(1000));
  bus.process(at_us(2000));
  EXPECT_EQ(ids(b), (std::vector<std::uint32_t>{0x181, 0x201}));
}

TEST_F(VirtualCanBusTest, BusOffLosesTheQueueAndRefusesFrames) {
  bus.host().send(frame(0x201), at_us(0));
  bus.host().send(frame(0x201), at_us(0));
  bus.process(at_us(50));
  bus.host_bus_off(at_us(10'000));
  EXPECT_FALSE(bus.host().send(frame(0x201), at_us(60)));
  bus.send(port_a, frame(0x181), at_us(60));
  bus.process(at_us(9'999));
  EXPECT_EQ(ids(b), (std::vector<std::uint32_t>{0x181}));
  EXPECT_FALSE(bus.host().receive());
  EXPECT_TRUE(bus.host().send(frame(0x201), at_us(10'000)));
  bus.process(at_us(20'000));
  EXPECT_EQ(ids(b), (std::vector<std::uint32_t>{0x181, 0x201}));
}

TEST_F(VirtualCanBusTest, LoadIsCountedPerSecond) {
  for (std::int64_t i = 0; i < 1000; ++i) {
    bus.host().send(frame(0x201), at_us(i * 1000));
    bus.process(at_us(i * 1000 + 999));
  }
  bus.process(at_us(2'500'000));
  EXPECT_NEAR(bus.statistics().load_peak, 0.125, 1e-12);
  EXPECT_EQ(bus.statistics().load_last_second, 0.0);
}

TEST(VirtualCanBus, RefusesImpossibleBitrates) {
  EXPECT_THROW(VirtualCanBus("can0", 9'999), std::invalid_argument);
  EXPECT_THROW(VirtualCanBus("can0", 1'000'001), std::invalid_argument);
}

}  // namespace
}  // namespace interpolated_motion::transport
