#include "interpolated_motion_driver/transport/can_error_frame.h"

#include <gtest/gtest.h>

namespace interpolated_motion::transport {
namespace {

using Data = std::array<std::uint8_t, 8>;

// Classes and bytes as linux/can/error.h defines them.
TEST(CanErrorFrame, BusOff) {
  const CanErrorReport report = decode_can_error(0x040, Data{});
  EXPECT_TRUE(report.bus_off);
  EXPECT_FALSE(report.restarted);
  EXPECT_EQ(to_string(report), "bus-off");
}

TEST(CanErrorFrame, RestartedAfterBusOff) {
  const CanErrorReport report = decode_can_error(0x100, Data{});
  EXPECT_TRUE(report.restarted);
  EXPECT_FALSE(report.bus_off);
  EXPECT_EQ(to_string(report), "restarted after bus-off");
}

TEST(CanErrorFrame, ControllerStatesWithErrorCounters) {
  const CanErrorReport passive = decode_can_error(0x004, Data{0, 0x20, 0, 0, 0, 0, 128, 3});
  EXPECT_TRUE(passive.error_passive);
  EXPECT_FALSE(passive.error_warning);
  EXPECT_EQ(to_string(passive), "error passive (error counters: transmit 128, receive 3)");
  const CanErrorReport warning = decode_can_error(0x004, Data{0, 0x04, 0, 0, 0, 0, 0, 96});
  EXPECT_TRUE(warning.error_warning);
  EXPECT_EQ(warning.receive_errors, 96);
  const CanErrorReport active = decode_can_error(0x204, Data{0, 0x40});
  EXPECT_TRUE(active.error_active);
  EXPECT_EQ(active.transmit_errors, 0) << "counters of 0 count when the driver says that it tells them";
  EXPECT_FALSE(decode_can_error(0x004, Data{0, 0x40}).transmit_errors);
}

TEST(CanErrorFrame, OverflowsOfTheController) {
  const CanErrorReport report = decode_can_error(0x004, Data{0, 0x03});
  EXPECT_TRUE(report.receive_overflow);
  EXPECT_TRUE(report.transmit_overflow);
}

TEST(CanErrorFrame, SeveralFindingsMostSeriousFirst) {
  const CanErrorReport report = decode_can_error(0x0AA, Data{0, 0xFF});
  EXPECT_FALSE(report.error_passive) << "byte 1 counts with class 0x004 only";
  EXPECT_EQ(to_string(report), "no acknowledgement, protocol violation, arbitration lost, bus error");
}

TEST(CanErrorFrame, TransceiverAndTimeOut) {
  EXPECT_EQ(to_string(decode_can_error(0x011, Data{})),
            "transceiver reports a wire fault, transmission timed out");
  EXPECT_EQ(to_string(decode_can_error(0, Data{})), "unspecified error");
}

}  // namespace
}  // namespace interpolated_motion::transport
