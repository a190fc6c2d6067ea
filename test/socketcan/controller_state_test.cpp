// Bit rate, error frames and bus-off: SocketcanBus on a controller that has them.

#include <chrono>
#include <thread>

#include <gtest/gtest.h>
#include <boost/asio/io_context.hpp>

#include "interpolated_motion_driver/transport/host_clock.h"
#include "interpolated_motion_driver/transport/socketcan_bus.h"
#include "slcan_interface.h"

namespace interpolated_motion::transport {
namespace {

struct ControllerStateTest : testing::Test {
  boost::asio::io_context io;
  Slcan slcan;

  void SetUp() override {
    if (slcan.name().empty()) GTEST_SKIP() << "the kernel has no slcan";
    if (!slcan.set("up type can bitrate 500000")) GTEST_SKIP() << "slcan has no bit rate before Linux 6.0";
  }

  SocketcanParameters parameters(std::uint32_t bitrate) const {
    SocketcanParameters p;
    p.interface = slcan.name();
    p.bitrate = bitrate;
    return p;
  }

  /// The next error frame; waits for it.
  std::optional<CanErrorReport> next_error(SocketcanBus& bus) {
    const HostTime end = read_host_clock() + std::chrono::seconds(10);
    while (read_host_clock() < end) {
      bus.receive();
      if (auto report = bus.take_error()) return report;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::nullopt;
  }
};

TEST_F(ControllerStateTest, TheBitRateIsReadAndComparedWithTheConfiguration) {
  // S6 sets 500 kbit/s and O opens the channel.
  EXPECT_TRUE(slcan.hears("S6\rO\r"));
  SocketcanBus right(io, parameters(500'000), read_host_clock());
  EXPECT_EQ(right.state(), SocketcanState::Up);
  EXPECT_EQ(right.interface()->bitrate, 500'000U);
  EXPECT_EQ(right.status_text(), "CAN interface " + slcan.name() + " is up at 500000 bit/s");

  SocketcanBus wrong(io, parameters(1'000'000), read_host_clock());
  EXPECT_EQ(wrong.state(), SocketcanState::Unusable);
  EXPECT_EQ(wrong.status_text(),
            slcan.name() + " runs at 500000 bit/s, but the configuration says 1000000 bit/s; sending would " +
                "disturb the bus: sudo ip link set dev " + slcan.name() + " down && sudo ip link set dev " +
                slcan.name() + " up type can bitrate 1000000 restart-ms 100");
  EXPECT_FALSE(wrong.send({}, read_host_clock()));

  ASSERT_TRUE(slcan.set("down"));
  ASSERT_TRUE(slcan.set("up type can bitrate 1000000"));
  EXPECT_TRUE(wrong.poll_interface(read_host_clock() + std::chrono::seconds(1)));
  EXPECT_EQ(wrong.state(), SocketcanState::Up);
}

TEST_F(ControllerStateTest, AFrameReachesTheAdapterAndOneComesBack) {
  SocketcanBus bus(io, parameters(500'000), read_host_clock());
  canopen::Frame frame;
  frame.id = 0x201;
  frame.length = 2;
  frame.data = {0xCA, 0xFE};
  ASSERT_TRUE(bus.send(frame, read_host_clock()));
  EXPECT_TRUE(slcan.hears("t2012CAFE\r"));
  slcan.say("t1811A5\r");
  bool seen = false;
  const HostTime end = read_host_clock() + std::chrono::seconds(10);
  while (!seen && read_host_clock() < end) {
    const auto received = bus.receive();
    if (!received || received->own) continue;
    seen = true;
    EXPECT_EQ(received->frame.id, 0x181U);
    EXPECT_EQ(received->frame.length, 1);
    EXPECT_EQ(received->frame.data[0], 0xA5);
  }
  EXPECT_TRUE(seen);
}

// The adapter reports states as s, the state's letter, and the receive and transmit error counters.
TEST_F(ControllerStateTest, ErrorFramesTellTheControllersStates) {
  SocketcanBus bus(io, parameters(500'000), read_host_clock());
  slcan.say("sp010130\r");
  const auto passive = next_error(bus);
  ASSERT_TRUE(passive);
  EXPECT_TRUE(passive->error_passive);
  EXPECT_FALSE(passive->bus_off);
  EXPECT_EQ(passive->transmit_errors, 130);
  EXPECT_EQ(passive->receive_errors, 10);
  EXPECT_EQ(bus.state(), SocketcanState::Up);

  slcan.say("sb000255\r");
  const auto off = next_error(bus);
  ASSERT_TRUE(off);
  EXPECT_TRUE(off->bus_off);
  EXPECT_EQ(bus.state(), SocketcanState::BusOff);
  EXPECT_EQ(bus.counters().bus_off, 1U);
  EXPECT_FALSE(bus.send({}, read_host_clock()));
  EXPECT_NE(bus.status_text().find("sudo ip link set dev " + slcan.name() + " type can restart"),
            std::string::npos)
      << bus.status_text();
}

TEST_F(ControllerStateTest, ARestartEndsBusOff) {
  SocketcanBus bus(io, parameters(500'000), read_host_clock());
  slcan.say("sb000255\r");
  ASSERT_TRUE(next_error(bus));
  ASSERT_EQ(bus.state(), SocketcanState::BusOff);
  bus.poll_interface(read_host_clock());
  EXPECT_EQ(bus.state(), SocketcanState::BusOff) << "the kernel says so, too";
  if (!slcan.set("type can restart")) {
    // A driver without that command: down and up does it.
    ASSERT_TRUE(slcan.set("down"));
    ASSERT_TRUE(slcan.set("up"));
  }
  const HostTime end = read_host_clock() + std::chrono::seconds(10);
  while (bus.state() != SocketcanState::Up && read_host_clock() < end) {
    bus.receive();
    bus.poll_interface(read_host_clock());
  }
  EXPECT_EQ(bus.state(), SocketcanState::Up);
  EXPECT_TRUE(bus.send({}, read_host_clock()));
}

TEST_F(ControllerStateTest, UnpluggingTheAdapterRemovesTheInterface) {
  SocketcanBus bus(io, parameters(500'000), read_host_clock());
  slcan.unplug();
  const HostTime end = read_host_clock() + std::chrono::seconds(10);
  while (bus.state() != SocketcanState::Missing && read_host_clock() < end) {
    bus.receive();
    bus.poll_interface(read_host_clock());
  }
  EXPECT_EQ(bus.state(), SocketcanState::Missing);
}

}  // namespace
}  // namespace interpolated_motion::transport
