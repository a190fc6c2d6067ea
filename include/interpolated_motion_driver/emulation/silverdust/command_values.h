#pragma once

#include <cstdint>
#include <limits>

namespace interpolated_motion::emulation {

/// Ranges of the numbers that come with commands, and their forms inside the drive.
namespace command_value {

/// Ends of the ranges of the protocol's numbers, all included: 32 bits signed and unsigned, 16 bits signed,
/// and a word.
inline constexpr std::int64_t kInt32Min = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int64_t kInt32Max = std::numeric_limits<std::int32_t>::max();
inline constexpr std::int64_t kUint32Max = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::int64_t kInt16Max = std::numeric_limits<std::int16_t>::max();
inline constexpr std::int64_t kWordMax = std::numeric_limits<std::uint16_t>::max();

/// `low` <= `value` <= `high`.
inline bool in_range(std::int64_t value, std::int64_t low, std::int64_t high) {
  return value >= low && value <= high;
}

/// A word of 16 bit.
inline bool is_word(std::int64_t value) { return in_range(value, 0, kWordMax); }

/// A value of 32 bit, which may be written signed or unsigned.
inline bool is_long(std::int64_t value) { return in_range(value, kInt32Min, kUint32Max); }

/// The low 16 bits.
inline std::uint16_t to_word(std::int64_t value) { return static_cast<std::uint16_t>(value); }

/// The low 32 bits, signed.
inline std::int32_t to_int32(std::int64_t value) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
}

}  // namespace command_value
}  // namespace interpolated_motion::emulation
