#pragma once

#include <cstdint>
#include <string>

namespace interpolated_motion::silverlode {

/// Polling status word (POL, POR). Bits stay set until they have been read and then cleared with CPL.
struct PollingStatus {
  std::uint16_t raw = 0;  ///< as it is on the line

  /// Bit `n`, 0..15; the bits with a name below.
  bool bit(unsigned n) const { return (raw >> n & 1u) != 0; }
  bool aborted_packet() const { return bit(0); }  ///< of the drive's receiver: it did not come to its end
  bool receive_checksum_error() const { return bit(1); }
  bool soft_limit() const { return bit(2); }              ///< a software travel limit was met
  bool kill_motor() const { return bit(3); }              ///< shut down by a kill-motor condition
  bool framing_error() const { return bit(4); }           ///< a character without its stop bit
  bool message_too_long() const { return bit(5); }        ///< for the drive's receiver
  bool check_status_condition() const { return bit(6); }  ///< of CKS
  bool receive_overflow() const { return bit(7); }        ///< of the receive buffer
  bool moving_error() const { return bit(8); }            ///< beyond the limit of ERL in motion
  bool holding_error() const { return bit(9); }           ///< beyond the limit of ERL at rest
  bool voltage_error() const { return bit(10); }          ///< low or over
  bool ended_by_input() const { return bit(11); }         ///< a motion, by its stop condition
  bool command_error() const { return bit(12); }          ///< a command could not be executed
  bool motion_done() const { return bit(13); }            ///< the program or motion command has completed
  bool memory_error() const { return bit(14); }           ///< non-volatile memory
  bool immediate_done() const { return bit(15); }         ///< an immediate command has completed

  /// The drive does not (or must not be trusted to) go on: shut down, soft limit, moving or holding error,
  /// voltage, non-volatile memory.
  bool fault() const;
  /// Something on the line went wrong as the drive sees it: packets aborted, too long or overflowing,
  /// framing, checksum.
  bool line_error() const;
  /// "shut down by kill-motor condition, moving error (0x0108)"; "no status (0x0000)".
  std::string text() const;
};

/// Internal status word (RIS). Latched bits are cleared with CIS. No bit tells that the motor driver is
/// enabled.
struct InternalStatus {
  std::uint16_t raw = 0;  ///< as it is on the line

  /// Bit `n`, 0..15; the bits with a name below.
  bool bit(unsigned n) const { return (raw >> n & 1u) != 0; }
  bool index_found() const { return bit(0); }  ///< of the encoder
  /// Result of the last calculation command, as the next two.
  bool last_calculation_zero() const { return bit(1); }
  bool last_calculation_positive() const { return bit(2); }
  bool last_calculation_negative() const { return bit(3); }
  bool input(unsigned n) const { return bit(3 + n); }  ///< 1..3, true: high
  bool temperature_ok() const { return bit(7); }       ///< false: over temperature
  bool moving_error() const { return bit(8); }         ///< beyond the limit of ERL in motion
  bool holding_error() const { return bit(9); }        ///< beyond the limit of ERL at rest
  bool halted() const { return bit(10); }              ///< HLT was received
  bool input_found() const { return bit(11); }         ///< the last motion met its stop condition
  bool delay_expired() const { return bit(12); }       ///< of a wait or delay
  bool over_voltage() const { return bit(13); }
  bool low_voltage() const { return bit(14); }

  /// Over temperature, moving or holding error, halted, over or low voltage.
  bool fault() const;
  /// "moving error, over temperature (0x0173)": the faults first, then the rest; "no fault (0x00F3)" without
  /// any.
  std::string text() const;
};

/// I/O status word (RIO): states of now, nothing is latched.
struct IoStatus {
  std::uint16_t raw = 0;  ///< as it is on the line

  /// Bit `n`, 0..15; the bits with a name below.
  bool bit(unsigned n) const { return (raw >> n & 1u) != 0; }
  bool index() const { return bit(0); }
  bool internal_index() const { return bit(1); }
  bool external_index() const { return bit(2); }
  bool trajectory_active() const { return bit(3); }  ///< the interpolated motion, or another one, runs
  /// I/O line 1..7, true: high.
  bool io(unsigned n) const { return bit(n <= 3 ? 3 + n : 8 + n); }
  bool temperature_ok() const { return bit(7); }  ///< false: over temperature
  bool moving_error() const { return bit(8); }    ///< beyond the limit of ERL in motion
  bool holding_error() const { return bit(9); }   ///< beyond the limit of ERL at rest
  bool delay_running() const { return bit(10); }  ///< the delay counter is not 0

  /// Over temperature, moving or holding error.
  bool fault() const;
  /// "trajectory generator active (0x0088)".
  std::string text() const;
};

}  // namespace interpolated_motion::silverlode
