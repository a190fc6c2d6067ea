#include <gtest/gtest.h>

#include <random>

#include "interpolated_motion_driver/protocol/cia402/buffer_status.h"
#include "interpolated_motion_driver/protocol/cia402/controlword.h"
#include "interpolated_motion_driver/protocol/cia402/emergency.h"
#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"
#include "interpolated_motion_driver/protocol/cia402/identity.h"
#include "interpolated_motion_driver/protocol/cia402/interpolation_data_record.h"
#include "interpolated_motion_driver/protocol/cia402/modes.h"
#include "interpolated_motion_driver/protocol/cia402/objects.h"
#include "interpolated_motion_driver/protocol/cia402/statusword.h"
#include "protocol/property_cases.h"

namespace interpolated_motion::cia402 {
namespace {

TEST(StatuswordDecoding, StatesOfEpos2) {
  // Patterns of EPOS2's state table, without and with bit 9 (remote).
  const std::pair<std::uint16_t, State> patterns[] = {
      {0x0000, State::NotReadyToSwitchOn},  {0x0100, State::NotReadyToSwitchOn},
      {0x0140, State::SwitchOnDisabled},    {0x0121, State::ReadyToSwitchOn},
      {0x0123, State::SwitchedOn},          {0x4123, State::SwitchedOn},
      {0x4133, State::SwitchedOn},          {0x0137, State::OperationEnabled},
      {0x0117, State::QuickStopActive},     {0x010F, State::FaultReactionActive},
      {0x011F, State::FaultReactionActive}, {0x0108, State::Fault},
  };
  for (const auto& p : patterns) {
    EXPECT_EQ(Statusword{p.first}.state(), p.second) << std::hex << p.first;
    // Bits 9 to 15 and bit 7 belong to no state.
    for (unsigned bit : {7u, 9u, 10u, 11u, 12u, 13u, 15u}) {
      EXPECT_EQ(Statusword{static_cast<std::uint16_t>(p.first | 1u << bit)}.state(), p.second);
    }
  }
  EXPECT_EQ(Statusword{0x0001}.state(), State::Unknown);
  EXPECT_EQ(Statusword{0x0005}.state(), State::Unknown);
}

TEST(StatuswordDecoding, BitsSeenOnHardwareInMode7) {
  const Statusword waiting{0x0737};  // enabled in mode 7, target reached
  EXPECT_TRUE(waiting.target_reached());
  EXPECT_FALSE(waiting.ip_mode_active());
  EXPECT_TRUE(waiting.remote());
  EXPECT_TRUE(waiting.power_stage_on());
  const Statusword playing{0x1337};
  EXPECT_TRUE(playing.ip_mode_active());
  EXPECT_FALSE(playing.target_reached());
  EXPECT_EQ(playing.text(), "operation enabled, ip mode active, remote (0x1337)");
  EXPECT_EQ((Statusword{0x0108}.text()), "fault, not remote (0x0108)");
  EXPECT_TRUE((Statusword{0x0800}.internal_limit()));
  EXPECT_TRUE((Statusword{0x4000}.power_stage_refresh()));
  EXPECT_TRUE((Statusword{0x8000}.homed()));
  EXPECT_TRUE((Statusword{0x0100}.offset_current_measured()));
  EXPECT_TRUE((Statusword{0x0080}.warning()));
  EXPECT_TRUE((Statusword{0x2000}.following_error()));
}

TEST(Controlwords, Values) {
  EXPECT_EQ(controlword::kShutdown, 0x06);
  EXPECT_EQ(controlword::kSwitchOn, 0x07);
  EXPECT_EQ(controlword::kEnableOperation, 0x0F);
  EXPECT_EQ(controlword::kStartInterpolation, 0x1F);
  EXPECT_EQ(controlword::kHalt, 0x010F);
  EXPECT_EQ(controlword::kQuickStop, 0x02);
  EXPECT_EQ(controlword::kDisableVoltage, 0x00);
  EXPECT_EQ(controlword::kFaultReset, 0x80);
}

/// What a drive of CiA 402 does with a controlword (figure "Power drive system FSA", transitions 2 to 12 and
/// 16).
State drive_reaction(State state, std::uint16_t word) {
  const bool disable_voltage = (word & 0x82) == 0x00;
  const bool quick_stop = (word & 0x86) == 0x02;
  const bool shutdown = (word & 0x87) == 0x06;
  const bool switch_on = (word & 0x8F) == 0x07;
  const bool enable = (word & 0x8F) == 0x0F;
  switch (state) {
    case State::SwitchOnDisabled:
      return shutdown ? State::ReadyToSwitchOn : state;
    case State::ReadyToSwitchOn:
      if (disable_voltage || quick_stop) return State::SwitchOnDisabled;
      if (enable) return State::OperationEnabled;
      return switch_on ? State::SwitchedOn : state;
    case State::SwitchedOn:
      if (disable_voltage || quick_stop) return State::SwitchOnDisabled;
      if (shutdown) return State::ReadyToSwitchOn;
      return enable ? State::OperationEnabled : state;
    case State::OperationEnabled:
      if (disable_voltage) return State::SwitchOnDisabled;
      if (quick_stop) return State::QuickStopActive;
      if (shutdown) return State::ReadyToSwitchOn;
      return switch_on ? State::SwitchedOn : state;
    case State::QuickStopActive:
      if (disable_voltage) return State::SwitchOnDisabled;
      return enable ? State::OperationEnabled : state;
    default:
      return state;
  }
}

TEST(ControlwordWalk, ReachesEveryStateFromEveryState) {
  const State starts[] = {State::SwitchOnDisabled, State::ReadyToSwitchOn, State::SwitchedOn,
                          State::OperationEnabled, State::QuickStopActive};
  const State targets[] = {State::SwitchOnDisabled, State::ReadyToSwitchOn, State::SwitchedOn,
                           State::OperationEnabled};
  for (State start : starts) {
    for (State target : targets) {
      State state = start;
      for (int step = 0; step < 4 && state != target; ++step) {
        const ControlStep next = next_controlword(state, target);
        ASSERT_EQ(next.kind, ControlStep::Kind::Send) << to_text(state) << " to " << to_text(target);
        const State after = drive_reaction(state, next.controlword);
        ASSERT_NE(after, state) << to_text(state) << " to " << to_text(target);
        state = after;
      }
      EXPECT_EQ(state, target) << to_text(start) << " to " << to_text(target);
      EXPECT_EQ(next_controlword(state, target).kind, ControlStep::Kind::Arrived);
    }
  }
}

TEST(ControlwordWalk, EnablesInMaxonsTwoSteps) {
  EXPECT_EQ(next_controlword(State::SwitchOnDisabled, State::OperationEnabled).controlword, 0x0006);
  EXPECT_EQ(next_controlword(State::ReadyToSwitchOn, State::OperationEnabled).controlword, 0x000F);
  EXPECT_EQ(next_controlword(State::OperationEnabled, State::QuickStopActive).controlword, 0x0002);
}

TEST(ControlwordWalk, SaysWhenAWordDoesNotHelp) {
  using Kind = ControlStep::Kind;
  EXPECT_EQ(next_controlword(State::Fault, State::OperationEnabled).kind, Kind::NeedsFaultReset);
  EXPECT_EQ(next_controlword(State::NotReadyToSwitchOn, State::OperationEnabled).kind, Kind::Wait);
  EXPECT_EQ(next_controlword(State::FaultReactionActive, State::SwitchOnDisabled).kind, Kind::Wait);
  EXPECT_EQ(next_controlword(State::Unknown, State::OperationEnabled).kind, Kind::Impossible);
  EXPECT_EQ(next_controlword(State::SwitchedOn, State::Fault).kind, Kind::Impossible);
  EXPECT_EQ(next_controlword(State::SwitchedOn, State::QuickStopActive).kind, Kind::Impossible);
  EXPECT_EQ(next_controlword(State::SwitchOnDisabled, State::QuickStopActive).kind, Kind::Impossible);
}

TEST(InterpolationDataRecordBytes, DocumentedLayout) {
  const std::array<std::uint8_t, 8> expected{0x00, 0xF0, 0xFF, 0xFF, 0x24, 0xFA, 0xFF, 0x0A};
  EXPECT_EQ(pack({-4096, -1500, 10}), expected);
  EXPECT_EQ(unpack_record(expected.data()), (InterpolationDataRecord{-4096, -1500, 10}));
}

TEST(InterpolationDataRecordBytes, AgreesWithASixtyFourBitNumber) {
  // Table 4-24 as one number, MSB first: time, velocity, position.
  std::mt19937_64 random(6);
  for (int i = 0; i < interpolated_motion::test::property_cases(1000); ++i) {
    const std::uint64_t number = random();
    std::uint8_t bytes[8];
    for (unsigned n = 0; n < 8; ++n) bytes[n] = static_cast<std::uint8_t>(number >> (8 * n));
    const InterpolationDataRecord record = unpack_record(bytes);
    EXPECT_EQ(record.time, number >> 56);
    EXPECT_EQ(record.position, static_cast<std::int32_t>(number & 0xFFFFFFFF));
    const auto velocity = static_cast<std::int32_t>(number >> 32 & 0xFFFFFF);
    EXPECT_EQ(record.velocity, velocity >= 0x800000 ? velocity - 0x1000000 : velocity);
    EXPECT_TRUE(std::equal(bytes, bytes + 8, pack(record).begin()));
  }
}

TEST(InterpolationDataRecordBytes, RangeOfVelocity) {
  EXPECT_TRUE(fits_record_velocity(8388607));
  EXPECT_FALSE(fits_record_velocity(8388608));
  EXPECT_TRUE(fits_record_velocity(-8388608));
  EXPECT_FALSE(fits_record_velocity(-8388609));
  EXPECT_FALSE(fits_record_velocity(std::int64_t{1} << 40));
  for (std::int32_t v : {kMinRecordVelocity, kMaxRecordVelocity}) {
    EXPECT_EQ(unpack_record(pack({0, v, 255}).data()).velocity, v);
  }
}

TEST(BufferStatusBits, OfTable435) {
  using Predicate = bool (BufferStatus::*)() const;
  const std::pair<int, Predicate> bits[] = {
      {0, &BufferStatus::underflow_warning}, {1, &BufferStatus::overflow_warning},
      {2, &BufferStatus::velocity_warning},  {3, &BufferStatus::acceleration_warning},
      {8, &BufferStatus::underflow_error},   {9, &BufferStatus::overflow_error},
      {10, &BufferStatus::velocity_error},   {11, &BufferStatus::acceleration_error},
      {14, &BufferStatus::enabled},          {15, &BufferStatus::ip_mode_active},
  };
  for (const auto& tested : bits) {
    const BufferStatus status{static_cast<std::uint16_t>(1u << tested.first)};
    for (const auto& other : bits) EXPECT_EQ((status.*other.second)(), other.first == tested.first);
    EXPECT_EQ(status.any_warning(), tested.first <= 3);
    EXPECT_EQ(status.any_error(), tested.first >= 8 && tested.first <= 11);
  }
}

TEST(BufferStatusBits, Text) {
  EXPECT_EQ((BufferStatus{0x4001}.text()), "underflow warning, buffer enabled (0x4001)");
  EXPECT_EQ((BufferStatus{0xC000}.text()), "buffer enabled, ip mode active (0xC000)");
  EXPECT_EQ((BufferStatus{0x0101}.text()), "underflow error, underflow warning (0x0101)");
  EXPECT_EQ((BufferStatus{0x0000}.text()), "buffer disabled (0x0000)");
}

TEST(Emergencies, CodesOfEpos2) {
  const std::pair<std::uint16_t, const char*> codes[] = {
      {0x0000, "reset"},          {0x1000, "generic"},     {0x2310, "over-current"}, {0x3210, "over-voltage"},
      {0x3220, "under-voltage"},  {0x4210, "temperature"}, {0x5113, "5 V"},          {0x5114, "output stage"},
      {0x6100, "software"},       {0x6320, "parameter"},   {0x7320, "sensor"},       {0x8110, "lost"},
      {0x8111, "overrun"},        {0x8120, "passive"},     {0x8130, "heartbeat"},    {0x8150, "collision"},
      {0x81FD, "bus off"},        {0x81FE, "receive"},     {0x81FF, "transmit"},     {0x8210, "PDO length"},
      {0x8611, "following"},      {0xFF01, "Hall"},        {0xFF02, "index"},        {0xFF03, "resolution"},
      {0xFF04, "not found"},      {0xFF06, "negative"},    {0xFF07, "positive"},     {0xFF08, "angle"},
      {0xFF09, "position limit"}, {0xFF0A, "breach"},      {0xFF0B, "overloaded"},   {0xFF0C, "interpolated"},
      {0xFF0D, "tuning"},         {0xFF0F, "gear"},        {0xFF10, "gain"},         {0xFF11, "main"},
      {0xFF12, "auxiliary"},      {0xFF0E, "unknown"},     {0x1001, "unknown"},
  };
  for (const auto& c : codes) {
    EXPECT_NE(describe_emergency(c.first).find(c.second), std::string_view::npos) << std::hex << c.first;
  }
}

TEST(Emergencies, Text) {
  EXPECT_EQ(error_register_text(0x00), "none");
  EXPECT_EQ(error_register_text(0x11), "generic, communication");
  EXPECT_EQ(error_register_text(0x80), "motion");
  canopen::Emcy emcy;
  emcy.code = 0xFF0C;
  emcy.error_register = 0x20;
  EXPECT_EQ(emergency_text(emcy),
            "EMCY 0xFF0C interpolated position mode error (error register 0x20: device profile)");
}

TEST(Modes, SupportedDriveModes) {
  // 0x3E5, read from an EPOS3: PP, PV, HM, IP, CSP, CSV, CST.
  for (Mode mode :
       {Mode::ProfilePosition, Mode::ProfileVelocity, Mode::Homing, Mode::InterpolatedPosition,
        Mode::CyclicSynchronousPosition, Mode::CyclicSynchronousVelocity, Mode::CyclicSynchronousTorque}) {
    EXPECT_TRUE(supports(0x3E5, mode)) << to_text(mode);
  }
  EXPECT_FALSE(supports(0x3E5, Mode::ProfileTorque));
  EXPECT_FALSE(supports(0xFFFFFFFF, Mode::Position));
  EXPECT_FALSE(supports(0xFFFFFFFF, Mode::None));
  EXPECT_FALSE(supports(0xA5, Mode::InterpolatedPosition));
  EXPECT_TRUE(supports(0x40, Mode::InterpolatedPosition));
  EXPECT_EQ(supported_modes_text(0x65),
            "profile position, profile velocity, homing, interpolated position (0x00000065)");
  EXPECT_EQ(supported_modes_text(0), "none known (0x00000000)");
  EXPECT_EQ(to_text(static_cast<Mode>(99)), "unknown");
  EXPECT_EQ(to_text(static_cast<Mode>(7)), "interpolated position");
}

TEST(EposObjects, MappingEntries) {
  EXPECT_EQ(pdo_entry::kInterpolationRecord.value(), 0x20C10040u);
  EXPECT_EQ(pdo_entry::kBufferStatus.value(), 0x20C40110u);
  EXPECT_EQ(pdo_entry::kFreeRecords.value(), 0x60C40220u);
  EXPECT_EQ(pdo_entry::kControlword.value(), 0x60400010u);
  EXPECT_EQ(pdo_entry::kModeOfOperation.value(), 0x60600008u);
  EXPECT_EQ(pdo_entry::kStatusword.value(), 0x60410010u);
  EXPECT_EQ(pdo_entry::kModeDisplay.value(), 0x60610008u);
  EXPECT_EQ(pdo_entry::kPositionDemand.value(), 0x60620020u);
  EXPECT_EQ(pdo_entry::kPositionActual.value(), 0x60640020u);
  EXPECT_EQ(pdo_entry::kVelocityActual.value(), 0x606C0020u);
  EXPECT_EQ(pdo_entry::kFollowingError.value(), 0x20F40010u);
  EXPECT_EQ(pdo_entry::kTimeStamp.value(), 0x10130020u);
}

TEST(EposObjects, NamesAreFoundForListedObjectsOnly) {
  EXPECT_STREQ(epos_object_name({0x1000, 0}), "Device Type");
  EXPECT_STREQ(epos_object_name({0x20C4, 1}), "Interpolation Buffer Status");
  EXPECT_STREQ(epos_object_name({0x60C4, 4}), "Buffer Position");
  EXPECT_STREQ(epos_object_name({0x607D, 2}), "Max Position Limit");
  EXPECT_STREQ(epos_object_name({0x6502, 0}), "Supported Drive Modes");
  EXPECT_STREQ(epos_object_name({0x60C1, 1}), "");
  EXPECT_STREQ(epos_object_name({0x6064, 1}), "");
}

TEST(Objects, NamesAreThoseOfCiaOnly) {
  EXPECT_STREQ(object_name({0x1000, 0}), "Device Type");
  EXPECT_STREQ(object_name({0x1006, 0}), "Communication Cycle Period");
  EXPECT_STREQ(object_name({0x60C5, 0}), "Max Acceleration");
  EXPECT_STREQ(object_name({0x60F4, 0}), "Following Error Actual Value");
  EXPECT_STREQ(object_name({0x6502, 0}), "Supported Drive Modes");
  EXPECT_STREQ(object_name({0x20C4, 1}), "");
}

TEST(EposObjects, IdentityText) {
  EXPECT_EQ(describe_identity({0xFB, 0x64200000, 0x21260000, 1}), "maxon EPOS2 70/10, firmware 0x2126");
  EXPECT_EQ(describe_identity({0xFB, 0x63220000, 0x21000000, 1}),
            "maxon drive, hardware 0x6322, firmware 0x2100");
  EXPECT_EQ(describe_identity({0x9A, 0x30, 0x10002, 1}), "vendor 0x0000009A, product 0x00000030");
}

}  // namespace
}  // namespace interpolated_motion::cia402
