#include <gtest/gtest.h>

#include "wire_host.h"

// Device control of CiA 402 with the statuswords of EPOS2, at the wire, in Operational (bit 9).
namespace interpolated_motion::emulation {
namespace {

struct DeviceControlAtTheWire : testing::Test {
  WireHost host;
  void SetUp() override {
    host.boot();
    host.nmt(1);
    ASSERT_EQ(host.write(0x6060, 0, 7, 1), 0U);
  }
  void expect_after(unsigned controlword, unsigned statusword) {
    host.control(controlword);
    host.run(ms(2));
    EXPECT_EQ(host.status(), statusword) << std::hex << "after controlword " << controlword;
  }
};

TEST_F(DeviceControlAtTheWire, WalkStepByStep) {
  expect_after(0x07, 0x0340);
  expect_after(0x0F, 0x0340);
  expect_after(0x06, 0x0321);
  expect_after(0x07, 0x0323);
  expect_after(0x0F, 0x0737);
  expect_after(0x07, 0x0323);
  expect_after(0x06, 0x0321);
  expect_after(0x00, 0x0340);
}

TEST_F(DeviceControlAtTheWire, EnableGoesThroughSwitchedOnInOneStep) {
  expect_after(0x06, 0x0321);
  expect_after(0x0F, 0x0737);
  expect_after(0x06, 0x0321);
  expect_after(0x0F, 0x0737);
  expect_after(0x00, 0x0340);
}

TEST_F(DeviceControlAtTheWire, QuickStop) {
  expect_after(0x06, 0x0321);
  expect_after(0x02, 0x0340);
  expect_after(0x06, 0x0321);
  expect_after(0x0F, 0x0737);
  expect_after(0x02, 0x0317);
  expect_after(0x0F, 0x0737);
  expect_after(0x02, 0x0317);
  expect_after(0x00, 0x0340);
}

TEST_F(DeviceControlAtTheWire, FaultIsLeftOnTheRisingEdgeOfBitSevenOnly) {
  expect_after(0x80, 0x0340);
  host.drive->raise_fault(0x1000, 0, host.world.now());
  host.run(ms(2));
  EXPECT_EQ(host.status(), 0x0308U);
  expect_after(0x80, 0x0308);
  expect_after(0x0F, 0x0308);
  expect_after(0x80, 0x0340);
  expect_after(0x86, 0x0321);
}

TEST_F(DeviceControlAtTheWire, HaltAtRestKeepsTargetReached) {
  expect_after(0x06, 0x0321);
  expect_after(0x0F, 0x0737);
  expect_after(0x10F, 0x0737);
}

TEST_F(DeviceControlAtTheWire, HomedBitAndModes) {
  EposParameters parameters;
  parameters.homed = true;
  WireHost homed(parameters);
  homed.boot();
  EXPECT_EQ(homed.status(), 0x8140U);
  for (const int mode : {1, 3, 6, -1, 7}) {
    ASSERT_EQ(host.write(0x6060, 0, mode, 1), 0U) << mode;
    EXPECT_EQ(static_cast<std::int8_t>(host.read(0x6061, 0)), mode);
  }
  for (const int mode : {5, 8})
    EXPECT_EQ(host.write(0x6060, 0, mode, 1), 0x06090030U) << "no bit of 0x6502 for mode " << mode;
  EXPECT_EQ(host.read(0x6061, 0), 7U);
}

}  // namespace
}  // namespace interpolated_motion::emulation
