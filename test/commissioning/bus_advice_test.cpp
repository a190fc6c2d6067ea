#include "interpolated_motion_driver/commissioning/bus_advice.h"

#include <gtest/gtest.h>

#include "bench.h"

namespace interpolated_motion::commissioning {
namespace {

transport::CanInterface can0() {
  transport::CanInterface interface;
  interface.name = "can0";
  interface.up = interface.can = true;
  interface.kind = "can";
  interface.bitrate = 500'000;
  interface.controller = transport::CanControllerState::ErrorPassive;
  return interface;
}

TEST(BusAdvice, TheInterfaceIsToldWithItsRate) {
  EXPECT_EQ(describe_interface(can0()), "can0: 500000 bit/s, controller error-passive");
  transport::CanInterface virtual_one;
  virtual_one.name = "vcan0";
  EXPECT_TRUE(contains(describe_interface(virtual_one), "vcan0: without a bit rate"));
}

TEST(BusAdvice, ErrorsWithoutAFrameLookLikeAWrongRate) {
  BusErrors errors;
  transport::CanErrorReport report;
  report.protocol_violation = true;
  errors.add(report);
  const auto texts = silent_bus_advice(can0(), errors, 0);
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_TRUE(contains(texts[0], "a wrong bit rate looks like"));
  EXPECT_TRUE(contains(texts[1], "can0 has 500000 bit/s"));
  EXPECT_TRUE(contains(
      texts[1], "sudo ip link set dev can0 down && sudo ip link set dev can0 up type can bitrate 1000000"));
}

TEST(BusAdvice, NobodyAcknowledges) {
  BusErrors errors;
  transport::CanErrorReport report;
  report.no_acknowledge = true;
  errors.add(report);
  EXPECT_TRUE(contains(silent_bus_advice(can0(), errors, 0).at(0), "nobody acknowledges what is sent"));
}

TEST(BusAdvice, ASilentBusAndOneOnWhichNobodyAnswers) {
  EXPECT_TRUE(contains(silent_bus_advice(can0(), {}, 0).at(0), "the bus is silent. Check the power"));
  const auto heard = silent_bus_advice(can0(), {}, 7);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_TRUE(contains(heard[0], "the bit rate is right"));
}

}  // namespace
}  // namespace interpolated_motion::commissioning
