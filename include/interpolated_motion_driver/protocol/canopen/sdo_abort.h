#pragma once

#include <cstdint>
#include <string_view>

namespace interpolated_motion::canopen {

/// SDO abort codes the driver itself sends or acts on (CiA 301, table 22).
namespace abort_code {

inline constexpr std::uint32_t kToggle = 0x05030000;             ///< toggle bit not alternated
inline constexpr std::uint32_t kTimeout = 0x05040000;            ///< no answer in time
inline constexpr std::uint32_t kCommand = 0x05040001;            ///< command specifier not valid or unknown
inline constexpr std::uint32_t kBlockSize = 0x05040002;          ///< block transfer: invalid block size
inline constexpr std::uint32_t kSequence = 0x05040003;           ///< block transfer: invalid sequence number
inline constexpr std::uint32_t kCrc = 0x05040004;                ///< block transfer: checksum wrong
inline constexpr std::uint32_t kMemory = 0x05040005;             ///< out of memory
inline constexpr std::uint32_t kUnsupportedAccess = 0x06010000;  ///< of this object
inline constexpr std::uint32_t kWriteOnly = 0x06010001;          ///< a read of it
inline constexpr std::uint32_t kReadOnly = 0x06010002;           ///< a write to it
inline constexpr std::uint32_t kNoObject = 0x06020000;           ///< no such index
inline constexpr std::uint32_t kLengthMismatch = 0x06070010;     ///< length of the data is not the object's
inline constexpr std::uint32_t kTooLong = 0x06070012;            ///< data longer than the object
inline constexpr std::uint32_t kTooShort = 0x06070013;           ///< data shorter than the object
inline constexpr std::uint32_t kNoSubindex = 0x06090011;         ///< no such sub-index
inline constexpr std::uint32_t kValueRange = 0x06090030;         ///< value out of the object's range
inline constexpr std::uint32_t kGeneral = 0x08000000;            ///< no reason given
inline constexpr std::uint32_t kDeviceState = 0x08000022;        ///< not in the drive's present state
inline constexpr std::uint32_t kWrongNmtState = 0x0F00FFC0;      ///< maxon

}  // namespace abort_code

/// What an abort code means, in words: those of CiA 301 and those of maxon (0x0F00FFxx). "unknown abort code"
/// for others.
std::string_view describe_abort(std::uint32_t code);

}  // namespace interpolated_motion::canopen
