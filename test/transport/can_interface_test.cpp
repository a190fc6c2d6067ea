#include "interpolated_motion_driver/transport/can_interface.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <gtest/gtest.h>
#include <boost/asio/io_context.hpp>

#include "failing_calls/failing_calls.h"
#include "interpolated_motion_driver/transport/socketcan_bus.h"

namespace interpolated_motion::transport {
namespace {

CanInterface real_interface() {
  CanInterface interface;
  interface.name = "can0";
  interface.up = interface.can = true;
  interface.kind = "can";
  interface.bitrate = 1'000'000;
  interface.transmit_queue = 128;
  interface.restart_ms = 100;
  return interface;
}

TEST(CanInterface, TheRightBitRateIsNoFault) {
  EXPECT_EQ(interface_fault(real_interface(), 1'000'000), "");
  EXPECT_EQ(interface_fault(real_interface(), 0), "");
}

TEST(CanInterface, AnotherBitRateIsAFaultWithACommandToFollow) {
  const std::string text = interface_fault(real_interface(), 500'000);
  EXPECT_EQ(
      text,
      "can0 runs at 1000000 bit/s, but the configuration says 500000 bit/s; sending would disturb the bus: "
      "sudo ip link set dev can0 down && sudo ip link set dev can0 up type can bitrate 500000 restart-ms "
      "100");
}

TEST(CanInterface, AVirtualInterfaceHasNoBitRateToCompare) {
  CanInterface interface = real_interface();
  interface.kind = "vcan";
  interface.bitrate.reset();
  interface.restart_ms.reset();
  interface.transmit_queue = 0;
  EXPECT_EQ(interface_fault(interface, 1'000'000), "");
  EXPECT_EQ(bring_up_command(interface, 1'000'000), "sudo ip link set dev can0 up");
  EXPECT_TRUE(interface_advice(interface, 128).empty());
}

TEST(CanInterface, ListenOnlyCannotSend) {
  CanInterface interface = real_interface();
  interface.listen_only = true;
  EXPECT_NE(interface_fault(interface, 1'000'000).find("listen-only off"), std::string::npos);
}

TEST(CanInterface, AdviceOnQueueAndRestart) {
  CanInterface interface = real_interface();
  EXPECT_TRUE(interface_advice(interface, 128).empty());
  interface.transmit_queue = 10;
  interface.restart_ms = 0;
  const auto advice = interface_advice(interface, 128);
  ASSERT_EQ(advice.size(), 2U);
  EXPECT_EQ(
      advice[0],
      "the transmit queue of can0 holds 10 frames only, so frames wait in the driver: sudo ip link set dev "
      "can0 txqueuelen 128");
  EXPECT_NE(advice[1].find("restart-ms 100"), std::string::npos);
}

TEST(CanInterface, ThereIsNoneOfAnUnknownNameAndLoopbackIsNotCan) {
  for (const char* name : {"no_such_link", "", "a_name_of_more_than_fifteen_letters"}) {
    const auto none = read_can_interface(name);
    ASSERT_FALSE(none) << name;
    EXPECT_EQ(none.error(), std::errc::no_such_device) << name;
  }
  const auto loopback = read_can_interface("lo");
  ASSERT_TRUE(loopback);
  EXPECT_EQ(loopback.value().name, "lo");
  EXPECT_EQ(loopback.value().index, 1);
  EXPECT_FALSE(loopback.value().can);
}

// For want of a descriptor nothing is known about the interface: it is not missing.
TEST(CanInterface, KernelThatCannotBeAskedSaysNothingOfIt) {
  const std::pair<const char*, int> failures[] = {{"socket", EMFILE}, {"send", ENOBUFS}, {"recv", ENOMEM}};
  for (const auto& [call, error] : failures) {
    boost::asio::io_context io;
    SocketcanParameters parameters;
    parameters.interface = "lo";
    SocketcanBus bus(io, parameters, HostTime{});
    const test::FailingCall failing(call, 1, error);
    const test::Counted counted;
    bus.poll_interface(HostTime{} + std::chrono::seconds(1));
    EXPECT_TRUE(failing.has_happened()) << call;
    EXPECT_EQ(bus.state(), SocketcanState::Unusable) << call;
    EXPECT_NE(bus.status_text().find(std::strerror(error)), std::string::npos) << bus.status_text();
  }
}

}  // namespace
}  // namespace interpolated_motion::transport
