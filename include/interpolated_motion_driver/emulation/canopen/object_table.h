#pragma once

#include <cstddef>
#include <cstdint>

#include "interpolated_motion_driver/emulation/canopen/object_entry.h"

namespace interpolated_motion::emulation {

/// The objects a kind of drive has: rows in the order of index and sub-index, which outlive this.
struct ObjectTable {
  const ObjectEntry* rows = nullptr;  ///< `size` of them, ascending by index, then by sub-index
  std::size_t size = 0;               ///< rows

  /// Row of an object; `size` when there is none.
  constexpr std::size_t slot(std::uint16_t index, std::uint8_t subindex) const {
    std::size_t low = 0;
    std::size_t high = size;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const ObjectEntry& entry = rows[middle];
      const bool before = entry.index < index || (entry.index == index && entry.subindex < subindex);
      (before ? low : high) = before ? middle + 1 : middle;
    }
    const bool found = low < size && rows[low].index == index && rows[low].subindex == subindex;
    return found ? low : size;
  }
};

/// Words to write a table with.
namespace object_table {

/// DataType and AccessType as an EDS names them (CiA 306).
constexpr auto I8 = ObjectType::I8;
constexpr auto I16 = ObjectType::I16;
constexpr auto I32 = ObjectType::I32;
constexpr auto U8 = ObjectType::U8;
constexpr auto U16 = ObjectType::U16;
constexpr auto U32 = ObjectType::U32;
constexpr auto U64 = ObjectType::U64;
constexpr auto String = ObjectType::String;
constexpr auto Ro = Access::Ro;
constexpr auto Wo = Access::Wo;
constexpr auto Rw = Access::Rw;
constexpr auto Rww = Access::Rww;
constexpr auto Const = Access::Const;

/// A row without default (0 at power-up) and range, in no PDO.
constexpr ObjectEntry object(std::uint16_t index, std::uint8_t subindex, ObjectType type, Access access) {
  ObjectEntry entry;
  entry.index = index;
  entry.subindex = subindex;
  entry.type = type;
  entry.access = access;
  return entry;
}

}  // namespace object_table
}  // namespace interpolated_motion::emulation
