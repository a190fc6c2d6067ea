#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace interpolated_motion::canopen {

/// Data types of objects, with the numbers of CiA 301, table 44. Others are kept as numbers.
enum class DataType : std::uint16_t {
  Unknown = 0,
  Boolean = 0x01,
  Integer8 = 0x02,
  Integer16 = 0x03,
  Integer32 = 0x04,
  Unsigned8 = 0x05,
  Unsigned16 = 0x06,
  Unsigned32 = 0x07,
  VisibleString = 0x09,
  Integer64 = 0x15,
  Unsigned64 = 0x1B,
};

/// "UNSIGNED32"; "UNKNOWN" for types that are not listed.
std::string to_text(DataType type);
/// The type of that name; Unknown for others.
DataType data_type(const std::string& name);

/// Bytes of an integer; 0 for a text, and where it is not known.
std::size_t size_of(DataType type);
/// Whether an integer has a sign; false for other types.
bool is_signed(DataType type);
/// The integer of `size` bytes, 1, 2, 4 or 8, with or without a sign; else Unknown.
DataType integer_type(std::size_t size, bool with_sign);

}  // namespace interpolated_motion::canopen
