#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/cia402/statusword.h"

namespace interpolated_motion::cia402 {

/// Controlwords, object 0x6040 (CiA 402; EPOS2 firmware specification; "EPOS3 Interpolated Position Mode",
/// table 4-30). Each is written whole: reading back and changing single bits is not reliable on EPOS.
namespace controlword {

inline constexpr std::uint16_t kDisableVoltage = 0x0000;  ///< to SwitchOnDisabled: power off at once
inline constexpr std::uint16_t kQuickStop = 0x0002;       ///< stops with the quick stop deceleration, 0x6085
inline constexpr std::uint16_t kShutdown = 0x0006;        ///< to ReadyToSwitchOn
inline constexpr std::uint16_t kSwitchOn = 0x0007;        ///< to SwitchedOn, from OperationEnabled too
inline constexpr std::uint16_t kEnableOperation =
    0x000F;                                           ///< in mode 7: ends playing, the axis stays in control
inline constexpr std::uint16_t kFaultReset = 0x0080;  ///< acts on the rising edge: write 0x0000 before

/// Mode 7: the drive plays its FIFO while set.
inline constexpr std::uint16_t kEnableIpMode = 0x0010;
/// Stops with the profile deceleration (0x6083/0x6084) while set.
inline constexpr std::uint16_t kHaltBit = 0x0100;

inline constexpr std::uint16_t kStartInterpolation = kEnableOperation | kEnableIpMode;  ///< 0x001F
inline constexpr std::uint16_t kHalt = kEnableOperation | kHaltBit;                     ///< 0x010F

}  // namespace controlword

/// What to do next on the way from one state to another.
struct ControlStep {
  enum class Kind {
    Arrived,          ///< the drive is in the state wanted
    Send,             ///< write `controlword`, then wait for the state to change
    Wait,             ///< the drive leaves this state by itself
    NeedsFaultReset,  ///< Fault: no walk leads out of it without saying so; write 0x0000, then 0x0080
    Impossible,       ///< the state wanted cannot be commanded, or the state is unknown
  };
  Kind kind = Kind::Wait;         ///< whether `controlword` is to be sent
  std::uint16_t controlword = 0;  ///< for Send
};

/// Next step from `current` to `target`, one of SwitchOnDisabled, ReadyToSwitchOn, SwitchedOn,
/// OperationEnabled and, from OperationEnabled, QuickStopActive. Enabling goes 0x0006, then 0x000F, which
/// switches on and enables in one step (maxon's sequence, EPOS2 application note "Interpolated Position
/// Mode"). In Fault the result is NeedsFaultReset for every target.
ControlStep next_controlword(State current, State target);

}  // namespace interpolated_motion::cia402
