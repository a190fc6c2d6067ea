#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace interpolated_motion::canopen {

/// Address of one value in a drive's object dictionary (CiA 301, 7.4).
struct ObjectAddress {
  std::uint16_t index = 0;    ///< 0x1000.. CiA 301, 0x2000.. the vendor's, 0x6000.. the device profile's
  std::uint8_t subindex = 0;  ///< 0 for a variable
};

/// Compared by index, then by sub-index: the order of the dictionary.
inline constexpr bool operator==(ObjectAddress a, ObjectAddress b) {
  return a.index == b.index && a.subindex == b.subindex;
}
inline constexpr bool operator!=(ObjectAddress a, ObjectAddress b) { return !(a == b); }
inline constexpr bool operator<(ObjectAddress a, ObjectAddress b) {
  return a.index != b.index ? a.index < b.index : a.subindex < b.subindex;
}

/// "0x60C4:02".
std::string to_string(ObjectAddress address);

/// Writes an integer of 1, 2, 4 or 8 bytes, least significant byte first, as CANopen transfers all of them.
template <class Integer>
inline void put_le(std::uint8_t* to, Integer value) {
  static_assert(std::is_integral_v<Integer>);
  const auto bits = static_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < sizeof(Integer); ++i) to[i] = static_cast<std::uint8_t>(bits >> (8 * i));
}

/// Reads an integer of 1, 2, 4 or 8 bytes, least significant byte first.
template <class Integer>
inline Integer get_le(const std::uint8_t* from) {
  static_assert(std::is_integral_v<Integer>);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) bits |= static_cast<std::uint64_t>(from[i]) << (8 * i);
  return static_cast<Integer>(bits);
}

/// The value of the lowest `bits` (1..64) of `value`, read as a two's complement number.
inline constexpr std::int64_t sign_extend(std::uint64_t value, unsigned bits) {
  const unsigned unused = 64 - bits;
  return static_cast<std::int64_t>(value << unused) >> unused;
}

/// One value to be written into the object dictionary by SDO.
struct SdoWrite {
  ObjectAddress address;    ///< must be writable in the drive
  std::uint8_t size = 0;    ///< bytes, 1..8: the size of the object
  std::uint64_t value = 0;  ///< two's complement in the lowest `size` bytes
};

inline constexpr bool operator==(const SdoWrite& a, const SdoWrite& b) {
  return a.address == b.address && a.size == b.size && a.value == b.value;
}

/// A write of the size of `Integer`: `sdo_write<std::int8_t>(address, 7)`. The type is named by the caller,
/// since a drive refuses a write of another size than the object has (abort 0x06070010).
template <class Integer>
inline SdoWrite sdo_write(ObjectAddress address, std::common_type_t<Integer> value) {
  using Bits = std::make_unsigned_t<Integer>;
  return {address, sizeof(Integer), static_cast<Bits>(value)};
}

}  // namespace interpolated_motion::canopen
