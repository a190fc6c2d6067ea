#include <gtest/gtest.h>

#include "interpolated_motion_driver/protocol/silverlode/nak.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"
#include "interpolated_motion_driver/protocol/silverlode/status_words.h"

namespace interpolated_motion::silverlode::test {
namespace {

TEST(PollingStatus, Texts) {
  EXPECT_EQ(PollingStatus{0x0108}.text(), "shut down by kill-motor condition, moving error (0x0108)");
  EXPECT_EQ(PollingStatus{0x2000}.text(), "motion completed (0x2000)");
  EXPECT_EQ(PollingStatus{0}.text(), "no status (0x0000)");
}

TEST(PollingStatus, EveryBitHasItsName) {
  const PollingStatus none{0};
  const char* const names[16] = {"packet aborted",
                                 "received checksum wrong",
                                 "soft limit",
                                 "shut down by kill-motor condition",
                                 "framing error",
                                 "message too long",
                                 "check-status condition met",
                                 "receive buffer overflow",
                                 "moving error",
                                 "holding error",
                                 "low or over voltage",
                                 "motion ended by input",
                                 "command error",
                                 "motion completed",
                                 "non-volatile memory error",
                                 "immediate command done"};
  for (unsigned n = 0; n < 16; ++n) {
    const PollingStatus status{static_cast<std::uint16_t>(1u << n)};
    EXPECT_EQ(status.text().rfind(names[n], 0), 0u) << n << ": " << status.text();
    EXPECT_EQ(status.text().find(','), std::string::npos) << n;
  }
  EXPECT_FALSE(none.fault());
}

TEST(PollingStatus, FaultsAndLineErrors) {
  const std::uint16_t faults = 1u << 2 | 1u << 3 | 1u << 8 | 1u << 9 | 1u << 10 | 1u << 14;
  const std::uint16_t line_errors = 1u << 0 | 1u << 1 | 1u << 4 | 1u << 5 | 1u << 7;
  for (unsigned n = 0; n < 16; ++n) {
    const PollingStatus status{static_cast<std::uint16_t>(1u << n)};
    EXPECT_EQ(status.fault(), (faults >> n & 1u) != 0) << n;
    EXPECT_EQ(status.line_error(), (line_errors >> n & 1u) != 0) << n;
  }
}

TEST(InternalStatus, HealthyDrive) {
  const InternalStatus status{0x00F3};
  EXPECT_FALSE(status.fault());
  EXPECT_TRUE(status.input(1) && status.input(2) && status.input(3));
  EXPECT_EQ(status.text(), "no fault, index found, input 1 high, input 2 high, input 3 high (0x00F3)");
}

TEST(InternalStatus, Faults) {
  EXPECT_EQ(InternalStatus{0x0100}.text(), "moving error, over temperature (0x0100)");
  EXPECT_EQ(InternalStatus{0x0480}.text(), "halt command received (0x0480)");
  for (const unsigned n : {8u, 9u, 10u, 13u, 14u}) {
    EXPECT_TRUE((InternalStatus{static_cast<std::uint16_t>(0x0080u | 1u << n)}.fault())) << n;
  }
  for (const unsigned n : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 11u, 12u, 15u}) {
    EXPECT_FALSE((InternalStatus{static_cast<std::uint16_t>(0x0080u | 1u << n)}.fault())) << n;
  }
  EXPECT_TRUE(InternalStatus{0x0000}.fault());
}

TEST(IoStatus, RunningAndLines) {
  const IoStatus running{0x0088};
  EXPECT_TRUE(running.trajectory_active());
  EXPECT_FALSE(running.fault());
  EXPECT_EQ(running.text(), "trajectory generator active (0x0088)");
  EXPECT_EQ(IoStatus{0x0080}.text(), "at rest (0x0080)");
  EXPECT_TRUE(IoStatus{0x0000}.fault());
  const unsigned bit_of_io[8] = {0, 4, 5, 6, 12, 13, 14, 15};
  for (unsigned n = 1; n <= 7; ++n) {
    EXPECT_TRUE((IoStatus{static_cast<std::uint16_t>(1u << bit_of_io[n])}.io(n))) << n;
    EXPECT_FALSE((IoStatus{static_cast<std::uint16_t>(~(1u << bit_of_io[n]))}.io(n))) << n;
  }
}

TEST(NakCode, Texts) {
  EXPECT_EQ(to_text(NakCode::DeviceBusy), "device busy");
  EXPECT_EQ(to_text(NakCode::BadFormat), "bad format");
  EXPECT_EQ(to_text(NakCode{6}), "buffer full");
  EXPECT_EQ(to_text(NakCode{11}), "unknown code");
}

TEST(Registers, Words) {
  EXPECT_EQ(register_value(0x0001, 0x6760), 92000);
  EXPECT_EQ(register_value(0xFFFF, 0xFFFE), -2);
  EXPECT_EQ(high_word(-2), 0xFFFF);
  EXPECT_EQ(low_word(0x12345678), 0x5678);
  EXPECT_EQ(position_error(0x0123FFF6), -10);
}

TEST(Registers, ImsControl) {
  EXPECT_EQ(encode_ims_control({false, 0}), 0);
  EXPECT_EQ(encode_ims_control({true, 30}), 0x0001001E);
  const ImsControl control = decode_ims_control(0x0001001E);
  EXPECT_TRUE(control.segment_used);
  EXPECT_EQ(control.first_register, 30);
}

// The vendor's numbers: 3865.47 units are 1 rev/s^2 and 32212254.7 are 1 rev/s; an IMS acceleration of .05 %
// of full scale (2000 RPM a tick) is 1073742, which reaches 1000 RPM (a quarter of full scale) within 1000
// ticks.
TEST(DriveScale, UnitsOfTheVendor) {
  const DriveScale scale;
  EXPECT_EQ(acceleration_units(1000 * 4000.0, scale), 3865471);
  EXPECT_EQ(velocity_units(4000, scale), 32212255);
  EXPECT_EQ(velocity_units(-1000 / 60.0 * 4000, scale), 536870912);
  EXPECT_EQ(ims_acceleration_units(1000 / 60.0 * 4000 / (1000 * 120e-6), scale), 1073742);
}

TEST(DriveScale, LimitsAndWayBack) {
  DriveScale scale;
  scale.counts_per_revolution = 8000;
  EXPECT_EQ(velocity_units(1e12, scale), 2147483647);
  EXPECT_EQ(acceleration_units(1e18, scale), 1 << 30);
  EXPECT_EQ(acceleration_units(0, scale), 1);
  EXPECT_NEAR(velocity_of_units(1 << 30, scale), 2000 / 60.0 * 8000, 1e-6);
  EXPECT_NEAR(acceleration_of_units(1 << 30, scale), 2000 / 60.0 * 8000 / 120e-6, 1e-3);
  EXPECT_NEAR(ims_acceleration_of_units(1 << 30, scale), 1000 / 60.0 * 8000 / 120e-6, 1e-3);
}

}  // namespace
}  // namespace interpolated_motion::silverlode::test
