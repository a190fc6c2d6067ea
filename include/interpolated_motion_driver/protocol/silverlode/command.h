#pragma once

#include <cstdint>
#include <string_view>

namespace interpolated_motion::silverlode {

/// Commands of the SilverLode Command Reference by their three-letter codes. Numbers below 64 are immediate:
/// the drive takes them at any time. Those above belong to programs: over the line a drive takes them only
/// when no program or motion runs, else it answers NAK 2 (device busy).
enum class Command : std::uint8_t {
  POL = 0,    ///< poll: the polling status word, or an ACK when it is 0
  CPL = 1,    ///< clear poll
  HLT = 2,    ///< halt: hard stop, driver disabled
  STP = 3,    ///< stop with a deceleration
  RST = 4,    ///< restart of the CPU, not answered
  RVN = 5,    ///< revision
  WRI = 11,   ///< write register, immediate
  RRG = 12,   ///< read registers
  RIS = 20,   ///< read internal status word
  RIO = 21,   ///< read I/O status word
  IMW = 25,   ///< interpolated move write queue
  POR = 27,   ///< poll, always answered with the polling status word
  MAV = 134,  ///< move absolute, with acceleration and velocity
  ZTP = 145,  ///< zero target and position
  TTP = 146,  ///< target to position
  ERL = 151,  ///< error limits
  CIS = 163,  ///< clear internal status
  KMC = 167,  ///< kill-motor conditions
  ADL = 173,  ///< delay of ACKs
  EMD = 227,  ///< enable motor driver
  DMD = 228,  ///< disable motor driver
  IMS = 253,  ///< interpolated move start
  IMQ = 254,  ///< interpolated move queue clear
};

/// "IMW"; "?" for a number that is none of the above.
std::string_view mnemonic(Command command);

}  // namespace interpolated_motion::silverlode
