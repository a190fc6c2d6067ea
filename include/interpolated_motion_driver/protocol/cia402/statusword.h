#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace interpolated_motion::cia402 {

/// States of the CiA 402 power drive system.
enum class State {
  NotReadyToSwitchOn,
  SwitchOnDisabled,
  ReadyToSwitchOn,
  SwitchedOn,
  OperationEnabled,
  QuickStopActive,
  FaultReactionActive,
  Fault,
  Unknown,  ///< the bits match none of the above
};

/// "operation enabled", ...
std::string_view to_text(State state);

/// Statusword, object 0x6041, as EPOS2 sends it: CiA 402, save that bit 4 tells whether the power stage is on
/// (not whether there is voltage), bit 8 that the current offset has been measured, bit 14 that the power
/// stage is being refreshed, and bit 15 that the axis has been homed. Bits 10 and 12 as in "EPOS3
/// Interpolated Position Mode", table 4-33.
struct Statusword {
  std::uint16_t raw = 0;  ///< as it is on the wire

  /// State by the masks of CiA 402 (0x4F and 0x6F); EPOS2's own patterns give the same.
  State state() const;

  /// Bit `n`, 0..15; the bits with a name below.
  bool bit(unsigned n) const { return (raw >> n & 1u) != 0; }
  bool power_stage_on() const { return bit(4); }           ///< EPOS2; elsewhere: there is voltage
  bool warning() const { return bit(7); }                  ///< the drive goes on
  bool offset_current_measured() const { return bit(8); }  ///< EPOS2
  bool remote() const { return bit(9); }           ///< NMT state Operational: the drive obeys the controlword
  bool target_reached() const { return bit(10); }  ///< with halt: velocity is 0
  bool internal_limit() const { return bit(11); }  ///< a limit of position, velocity or current acts
  bool ip_mode_active() const { return bit(12); }  ///< in mode 7: the drive plays its FIFO
  bool follows_command() const { return bit(12); }      ///< in mode 8: the drive follows its target positions
  bool following_error() const { return bit(13); }      ///< in the profile modes; reserved in mode 7
  bool power_stage_refresh() const { return bit(14); }  ///< EPOS2
  bool homed() const { return bit(15); }                ///< EPOS2: the position has a reference

  /// "operation enabled, ip mode active, remote (0x1337)".
  std::string text() const;
};

}  // namespace interpolated_motion::cia402
