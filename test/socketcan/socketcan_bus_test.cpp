#include "interpolated_motion_driver/transport/socketcan_bus.h"

#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>

#include "interfaces.h"
#include "interpolated_motion_driver/transport/host_clock.h"
#include "raw_can.h"

namespace interpolated_motion::transport {
namespace {

using std::chrono::milliseconds;

constexpr HostDuration kPatience = std::chrono::seconds(20);

canopen::Frame frame(std::uint32_t id, std::uint32_t number = 0) {
  canopen::Frame result;
  result.id = id;
  result.length = 8;
  std::memcpy(result.data.data(), &number, sizeof number);
  return result;
}

std::uint32_t number_of(const can_frame& raw) {
  std::uint32_t number = 0;
  std::memcpy(&number, raw.data, sizeof number);
  return number;
}

struct SocketcanBusTest : testing::Test {
  boost::asio::io_context io;
  Vcan vcan{"imdtest0"};

  SocketcanParameters parameters() const {
    SocketcanParameters p;
    p.interface = vcan.name();
    return p;
  }

  /// The next frame, waited for by the io_context as the driver does it. The kernel may deliver it after
  /// send() has returned.
  std::optional<canopen::ReceivedFrame> next(SocketcanBus& bus, milliseconds patience = milliseconds(2000)) {
    if (auto received = bus.receive()) return received;
    io.restart();
    bus.async_wait_readable([](const auto&) {});
    io.run_for(patience);
    return bus.receive();
  }

  /// As next(), for a loop that reads until the line is quiet.
  std::optional<canopen::ReceivedFrame> next_before_quiet(SocketcanBus& bus) {
    return next(bus, milliseconds(300));
  }

  /// Polls until the bus is in `state`.
  bool reaches(SocketcanBus& bus, SocketcanState state) {
    const HostTime end = read_host_clock() + kPatience;
    while (read_host_clock() < end) {
      bus.receive();
      bus.poll_interface(read_host_clock());
      if (bus.state() == state) return true;
      std::this_thread::sleep_for(milliseconds(10));
    }
    return false;
  }
};

TEST_F(SocketcanBusTest, AFrameCountsAsSentWhenItComesBackFromTheBus) {
  SocketcanBus bus(io, parameters(), read_host_clock());
  RawCan other(vcan.name());
  const HostTime before = read_host_clock();
  ASSERT_TRUE(bus.send(frame(0x201, 42), before));
  const auto seen = other.receive();
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->can_id, 0x201U);
  EXPECT_EQ(seen->can_dlc, 8);
  EXPECT_EQ(number_of(*seen), 42U);
  const auto own = next(bus);
  ASSERT_TRUE(own);
  EXPECT_TRUE(own->own);
  EXPECT_EQ(own->frame, frame(0x201, 42));
  EXPECT_GE(own->time, before);
  EXPECT_LE(own->time, read_host_clock());
  EXPECT_EQ(bus.counters().sent, 1U);
  EXPECT_EQ(bus.counters().received, 0U);
}

TEST_F(SocketcanBusTest, FramesOfOthersAreStampedWhenTheyCameNotWhenTheyAreRead) {
  SocketcanBus bus(io, parameters(), read_host_clock());
  RawCan other(vcan.name());
  ASSERT_TRUE(other.send(0x181, 7));
  const HostTime sent = read_host_clock();
  std::this_thread::sleep_for(milliseconds(50));
  const auto received = next(bus);
  ASSERT_TRUE(received);
  EXPECT_FALSE(received->own);
  EXPECT_EQ(received->frame, frame(0x181, 7));
  EXPECT_LE(received->time, sent + milliseconds(1));
  EXPECT_GE(received->time, sent - milliseconds(500));
  EXPECT_EQ(bus.counters().received, 1U);
}

TEST_F(SocketcanBusTest, ExtendedAndRemoteFramesTravelBothWays) {
  SocketcanBus bus(io, parameters(), read_host_clock());
  RawCan other(vcan.name());
  canopen::Frame extended = frame(0x1ABCDE01);
  extended.extended = true;
  canopen::Frame remote;
  remote.id = 0x189;
  remote.remote = true;
  remote.length = 2;
  ASSERT_TRUE(bus.send(extended, read_host_clock()));
  ASSERT_TRUE(bus.send(remote, read_host_clock()));
  EXPECT_EQ(other.receive()->can_id, 0x1ABCDE01U | CAN_EFF_FLAG);
  EXPECT_EQ(other.receive()->can_id, 0x189U | CAN_RTR_FLAG);
  EXPECT_EQ(next(bus)->frame, extended);
  EXPECT_EQ(next(bus)->frame, remote);
}

TEST_F(SocketcanBusTest, ClassicFramesTravelOverAnInterfaceThatHasFdFramesToo) {
  vcan.set_up(false);
  vcan.set("mtu 72");
  vcan.set_up(true);
  SocketcanBus bus(io, parameters(), read_host_clock());
  EXPECT_TRUE(bus.interface()->fd);
  RawCan other(vcan.name());
  ASSERT_TRUE(other.send_fd(0x182));
  ASSERT_TRUE(other.send(0x181, 1));
  const auto received = next(bus);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->frame, frame(0x181, 1));
  EXPECT_TRUE(bus.send(frame(0x201, 2), read_host_clock()));
  EXPECT_EQ(number_of(*other.receive()), 2U);
}

TEST_F(SocketcanBusTest, OnlyFramesOfTheNodesInUseArrive) {
  SocketcanParameters p = parameters();
  p.node_ids = {1, 127};
  p.further_ids = {0x3A5};
  SocketcanBus bus(io, p, read_host_clock());
  RawCan other(vcan.name());
  const std::vector<std::uint32_t> offered = {0x000, 0x080, 0x100, 0x081, 0x181, 0x182, 0x581,
                                              0x582, 0x77F, 0x701, 0x702, 0x3A5, 0x3A6, 0x181 | CAN_EFF_FLAG,
                                              0x201};
  for (const std::uint32_t id : offered) ASSERT_TRUE(other.send(id));
  std::vector<std::uint32_t> ids;
  while (ids.empty() || ids.back() != 0x201) {
    const auto received = next(bus);
    ASSERT_TRUE(received) << "the last of the frames offered did not arrive";
    ids.push_back(received->frame.id);
  }
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{0x000, 0x080, 0x100, 0x081, 0x181, 0x581, 0x77F, 0x701, 0x3A5,
                                             0x201}));
}

TEST_F(SocketcanBusTest, FramesThatTheFilterHidesDoNotCountAsOnTheirWay) {
  SocketcanParameters p = parameters();
  p.node_ids = {1};
  p.transmit_limit = 2;
  SocketcanBus bus(io, p, read_host_clock());
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(bus.send(frame(0x202), read_host_clock())) << i;
}

TEST_F(SocketcanBusTest, NoMoreThanTheLimitIsOnItsWay) {
  SocketcanParameters p = parameters();
  p.transmit_limit = 3;
  SocketcanBus bus(io, p, read_host_clock());
  for (std::uint32_t i = 0; i < 3; ++i) ASSERT_TRUE(bus.send(frame(0x201, i), read_host_clock()));
  EXPECT_FALSE(bus.send(frame(0x201, 3), read_host_clock()));
  ASSERT_TRUE(next(bus));
  EXPECT_TRUE(bus.send(frame(0x201, 3), read_host_clock()));
}

/// Sends `count` numbered frames as CanLink does, as fast as the bus takes them.
void send_all(SocketcanBus& bus, boost::asio::io_context& io, std::uint32_t count) {
  const HostTime end = read_host_clock() + kPatience;
  std::uint32_t confirmed = 0;
  for (std::uint32_t sent = 0; confirmed < count && read_host_clock() < end;) {
    while (sent < count && bus.send(frame(0x201 + sent % 12, sent), read_host_clock())) ++sent;
    while (const auto received = bus.receive()) {
      ASSERT_TRUE(received->own);
      ASSERT_EQ(received->frame, frame(0x201 + confirmed % 12, confirmed));
      ++confirmed;
    }
    io.restart();
    bus.async_wait_readable([](const auto&) {});
    io.run_one_for(milliseconds(1));
  }
  EXPECT_EQ(confirmed, count);
}

void expect_in_order(RawCan& other, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto seen = other.receive();
    ASSERT_TRUE(seen) << "frame " << i << " is missing";
    ASSERT_EQ(number_of(*seen), i);
    ASSERT_EQ(seen->can_id, 0x201 + i % 12);
  }
  EXPECT_FALSE(other.receive(20)) << "a frame too many";
}

// The prefill of twelve axes with 64 records each, through a queue of ten frames.
TEST_F(SocketcanBusTest, APrefillThroughAShortQueueLosesAndReordersNothing) {
  vcan.slow_down(10);
  SocketcanBus bus(io, parameters(), read_host_clock());
  RawCan other(vcan.name());
  const HostTime begin = read_host_clock();
  send_all(bus, io, 64 * 12);
  expect_in_order(other, 64 * 12);
  EXPECT_GT(bus.counters().queue_full, 0U) << "the queue was never full: nothing was tried";
  EXPECT_GT(read_host_clock() - begin, milliseconds(800)) << "the interface was not slow";
  EXPECT_EQ(bus.counters().sent, 64U * 12);
  EXPECT_EQ(bus.counters().unconfirmed, 0U);
}

TEST_F(SocketcanBusTest, APrefillThroughASmallSocketBufferLosesAndReordersNothing) {
  vcan.slow_down(1000);
  SocketcanParameters p = parameters();
  p.send_buffer = 1;  // the kernel makes it its minimum, a few frames
  SocketcanBus bus(io, p, read_host_clock());
  RawCan other(vcan.name());
  send_all(bus, io, 64 * 12);
  expect_in_order(other, 64 * 12);
  EXPECT_GT(bus.counters().socket_full, 0U) << "the buffer was never full: nothing was tried";
  EXPECT_EQ(bus.counters().queue_full, 0U);
}

TEST_F(SocketcanBusTest, AQueueFullOfOthersFramesIsTriedAgainByTheClock) {
  vcan.slow_down(4);
  SocketcanBus bus(io, parameters(), read_host_clock());
  RawCan other(vcan.name());
  HostTime now{};
  do {  // a frame may leave in between
    while (other.send(0x181)) {
    }
    now = read_host_clock();
  } while (bus.send(frame(0x201), now));
  ASSERT_EQ(bus.counters().queue_full, 1U);
  const HostTime deadline = bus.next_deadline();
  EXPECT_EQ(deadline, now + milliseconds(1));
  EXPECT_FALSE(bus.send(frame(0x201), now));
  EXPECT_EQ(bus.counters().queue_full, 1U) << "asked the kernel again too early";
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_TRUE(bus.send(frame(0x201), read_host_clock()));
}

std::uint32_t flood(RawCan& other, std::uint32_t count) {
  std::uint32_t sent = 0;
  for (std::uint32_t i = 0; i < count; ++i) sent += other.send(0x181, i) ? 1U : 0U;
  return sent;
}

TEST_F(SocketcanBusTest, TwentyThousandFramesFlatOutAreAllReceived) {
  SocketcanParameters p = parameters();
  p.receive_buffer = 32 << 20;
  SocketcanBus bus(io, p, read_host_clock());
  RawCan other(vcan.name());
  ASSERT_EQ(flood(other, 20'000), 20'000U);
  std::uint32_t expected = 0;
  while (const auto received = next_before_quiet(bus)) ASSERT_EQ(received->frame, frame(0x181, expected++));
  EXPECT_EQ(expected, 20'000U);
  EXPECT_EQ(bus.counters().receive_overflow, 0U);
}

TEST_F(SocketcanBusTest, FramesLostToASmallBufferAreCounted) {
  SocketcanParameters p = parameters();
  p.receive_buffer = 64 << 10;
  SocketcanBus bus(io, p, read_host_clock());
  RawCan other(vcan.name());
  ASSERT_EQ(flood(other, 20'000), 20'000U);
  std::uint64_t received = 0;
  while (next_before_quiet(bus)) ++received;
  const SocketcanCounters counters = bus.counters();
  EXPECT_GT(counters.receive_overflow, 0U);
  EXPECT_EQ(received + counters.receive_overflow, 20'000U);
  EXPECT_EQ(counters.received, received);
}

TEST_F(SocketcanBusTest, LostConfirmationsDoNotHoldUpSending) {
  SocketcanParameters p = parameters();
  p.receive_buffer = 64 << 10;
  p.transmit_limit = 3;
  SocketcanBus bus(io, p, read_host_clock());
  RawCan other(vcan.name());
  ASSERT_EQ(flood(other, 2000), 2000U);  // the buffer is full
  for (std::uint32_t i = 0; i < 3; ++i) ASSERT_TRUE(bus.send(frame(0x201, i), read_host_clock()));
  ASSERT_FALSE(bus.send(frame(0x201, 3), read_host_clock()));
  while (const auto received = next_before_quiet(bus)) ASSERT_FALSE(received->own) << "nothing was lost";
  ASSERT_TRUE(other.send(0x181));
  ASSERT_TRUE(next(bus));
  EXPECT_TRUE(bus.send(frame(0x201, 3), read_host_clock()));
  EXPECT_EQ(bus.counters().unconfirmed, 3U);
}

TEST_F(SocketcanBusTest, DownAndUpAgain) {
  SocketcanBus bus(io, parameters(), read_host_clock());
  EXPECT_TRUE(bus.poll_interface(read_host_clock())) << "the first state is news";
  EXPECT_FALSE(bus.poll_interface(read_host_clock()));
  ASSERT_EQ(bus.state(), SocketcanState::Up);
  vcan.set_up(false);
  ASSERT_TRUE(reaches(bus, SocketcanState::Down));
  EXPECT_EQ(bus.status_text(), "CAN interface imdtest0 is down: sudo ip link set dev imdtest0 up");
  EXPECT_FALSE(bus.send(frame(0x201), read_host_clock()));
  vcan.set_up(true);
  ASSERT_TRUE(reaches(bus, SocketcanState::Up));
  RawCan other(vcan.name());
  EXPECT_TRUE(bus.send(frame(0x201, 3), read_host_clock()));
  EXPECT_EQ(number_of(*other.receive()), 3U);
  EXPECT_EQ(bus.counters().openings, 2U);
}

TEST_F(SocketcanBusTest, SendingIntoADownInterfaceTakesNothing) {
  SocketcanBus bus(io, parameters(), read_host_clock());
  vcan.set_up(false);
  EXPECT_FALSE(bus.send(frame(0x201), read_host_clock()));
  EXPECT_EQ(bus.state(), SocketcanState::Down);
}

TEST_F(SocketcanBusTest, RemovedAndBackAgain) {
  SocketcanBus bus(io, parameters(), read_host_clock());
  boost::system::error_code told;
  bus.async_wait_readable([&told](const auto& error) { told = error; });
  vcan.remove();
  ASSERT_TRUE(reaches(bus, SocketcanState::Missing));
  io.run_for(milliseconds(100));
  EXPECT_NE(bus.status_text().find("there is no CAN interface imdtest0"), std::string::npos)
      << bus.status_text();
  EXPECT_FALSE(bus.send(frame(0x201), read_host_clock()));
  EXPECT_FALSE(bus.receive());
  EXPECT_LE(bus.next_deadline(), read_host_clock() + milliseconds(200));

  bus.async_wait_readable([&told](const auto& error) { told = error; });
  io.restart();
  io.run_for(milliseconds(100));
  EXPECT_EQ(told, boost::asio::error::not_connected);

  vcan.create();
  ASSERT_TRUE(reaches(bus, SocketcanState::Up));
  RawCan other(vcan.name());
  ASSERT_TRUE(other.send(0x181, 9));
  EXPECT_EQ(next(bus)->frame, frame(0x181, 9));
}

TEST_F(SocketcanBusTest, AnInterfaceMayAppearLater) {
  vcan.remove();
  SocketcanBus bus(io, parameters(), read_host_clock());
  EXPECT_EQ(bus.state(), SocketcanState::Missing);
  vcan.create();
  EXPECT_TRUE(reaches(bus, SocketcanState::Up));
}

TEST_F(SocketcanBusTest, AnotherKindOfInterfaceIsRefused) {
  SocketcanParameters p = parameters();
  p.interface = "lo";
  SocketcanBus bus(io, p, read_host_clock());
  EXPECT_EQ(bus.state(), SocketcanState::Unusable);
  EXPECT_NE(bus.status_text().find("lo is a network interface, but not one of CAN"), std::string::npos);
}

TEST_F(SocketcanBusTest, WrongParametersAreRefused) {
  const auto refused = [this](auto change) {
    SocketcanParameters p = parameters();
    change(p);
    EXPECT_THROW(SocketcanBus(io, p, read_host_clock()), std::invalid_argument);
  };
  refused([](auto& p) { p.interface = ""; });
  refused([](auto& p) { p.interface = "sixteen_letters_"; });
  refused([](auto& p) { p.bitrate = 1'000'001; });
  refused([](auto& p) { p.node_ids = {128}; });
  refused([](auto& p) { p.further_ids = {0x800}; });
  refused([](auto& p) { p.receive_buffer = 0; });
  refused([](auto& p) { p.send_buffer = -1; });
  refused([](auto& p) { p.transmit_limit = 0; });
}

}  // namespace
}  // namespace interpolated_motion::transport
