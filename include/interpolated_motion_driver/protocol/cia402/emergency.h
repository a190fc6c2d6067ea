#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "interpolated_motion_driver/protocol/canopen/emcy.h"

namespace interpolated_motion::cia402 {

/// Emergency error codes of EPOS2 that the driver acts on.
namespace emergency_code {

inline constexpr std::uint16_t kReset = 0x0000;           ///< the error has been reset
inline constexpr std::uint16_t kHeartbeat = 0x8130;       ///< life guard or heartbeat of this host missed
inline constexpr std::uint16_t kPdoLength = 0x8210;       ///< an RPDO was too short for its mapping
inline constexpr std::uint16_t kFollowingError = 0x8611;  ///< larger than 0x6065
inline constexpr std::uint16_t kPositionLimit = 0xFF09;   ///< software position limit, 0x607D
inline constexpr std::uint16_t kInterpolation = 0xFF0C;   ///< which error it was, only 0x20C4:01 tells

}  // namespace emergency_code

/// What an EPOS2 emergency error code means; "unknown error" for others. Not to be used for drives of other
/// vendors: the codes from 0xFF00 on mean something else there.
std::string_view describe_emergency(std::uint16_t code);

/// Names of the bits set in the error register, object 0x1001 (CiA 301, table 40): "generic, motion"; "none"
/// for 0.
std::string error_register_text(std::uint8_t error_register);

/// "EMCY 0xFF0C interpolated position mode error (error register 0x20: device profile)".
std::string emergency_text(const canopen::Emcy& emcy);

}  // namespace interpolated_motion::cia402
