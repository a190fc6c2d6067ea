#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "interpolated_motion_driver/emulation/object_entry.h"

namespace interpolated_motion::emulation {
namespace object_table {

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

constexpr ObjectEntry object(std::uint16_t index, std::uint8_t subindex, ObjectType type, Access access) {
  ObjectEntry entry;
  entry.index = index;
  entry.subindex = subindex;
  entry.type = type;
  entry.access = access;
  return entry;
}

}  // namespace object_table

/// Objects of an EPOS2 70/10, firmware 0x2126, as its EDS states them, in the order of index and sub-index.
/// Not in that table but named by its default PDO mapping: 0x60FF. Ranges are those of the EDS; the emulated
/// drive narrows some more.
inline constexpr auto kEposObjects = [] {
  using namespace object_table;
  return std::array{
      object(0x1000, 0, U32, Ro),
      object(0x1001, 0, U8, Ro),
      object(0x1003, 0, U8, Rw).value(0),
      object(0x1003, 1, U32, Ro),
      object(0x1003, 2, U32, Ro),
      object(0x1003, 3, U32, Ro),
      object(0x1003, 4, U32, Ro),
      object(0x1003, 5, U32, Ro),
      object(0x1005, 0, U32, Rw).value(0x80).range(0x80, 0x80),
      object(0x1008, 0, String, Const),
      object(0x100C, 0, U16, Rw).value(0),
      object(0x100D, 0, U8, Rw).value(0),
      object(0x1010, 0, U8, Ro).value(1),
      object(0x1010, 1, U32, Rw),
      object(0x1011, 0, U8, Ro).value(5),
      object(0x1011, 1, U32, Rw),
      object(0x1011, 4, U32, Rw),
      object(0x1011, 5, U32, Rw),
      object(0x1012, 0, U32, Rw).value(0x100),
      object(0x1013, 0, U32, Rww).pdo(),
      object(0x1014, 0, U32, Rw).plus_node(0x80),
      object(0x1016, 0, U8, Ro).value(2),
      object(0x1016, 1, U32, Rw).value(0),
      object(0x1016, 2, U32, Rw).value(0),
      object(0x1017, 0, U16, Rw).value(0),
      object(0x1018, 0, U8, Ro).value(4),
      object(0x1018, 1, U32, Ro),
      object(0x1018, 2, U32, Ro),
      object(0x1018, 3, U32, Ro),
      object(0x1018, 4, U32, Ro),
      object(0x1020, 0, U8, Ro).value(2),
      object(0x1020, 1, U32, Rw),
      object(0x1020, 2, U32, Rw),
      object(0x1200, 0, U8, Ro).value(2),
      object(0x1200, 1, U32, Ro).plus_node(0x600),
      object(0x1200, 2, U32, Ro).plus_node(0x580),
      object(0x1400, 0, U8, Ro).value(2),
      object(0x1400, 1, U32, Rw).plus_node(0x200),
      object(0x1400, 2, U8, Rw).value(255),
      object(0x1401, 0, U8, Ro).value(2),
      object(0x1401, 1, U32, Rw).plus_node(0x300),
      object(0x1401, 2, U8, Rw).value(255),
      object(0x1402, 0, U8, Ro).value(2),
      object(0x1402, 1, U32, Rw).plus_node(0x400),
      object(0x1402, 2, U8, Rw).value(255),
      object(0x1403, 0, U8, Ro).value(2),
      object(0x1403, 1, U32, Rw).plus_node(0x500),
      object(0x1403, 2, U8, Rw).value(255),
      object(0x1600, 0, U8, Rw).value(1).range(0, 8),
      object(0x1600, 1, U32, Rw).value(0x60400010),
      object(0x1600, 2, U32, Rw).value(0),
      object(0x1600, 3, U32, Rw).value(0),
      object(0x1600, 4, U32, Rw).value(0),
      object(0x1600, 5, U32, Rw).value(0),
      object(0x1600, 6, U32, Rw).value(0),
      object(0x1600, 7, U32, Rw).value(0),
      object(0x1600, 8, U32, Rw).value(0),
      object(0x1601, 0, U8, Rw).value(2).range(0, 8),
      object(0x1601, 1, U32, Rw).value(0x60400010),
      object(0x1601, 2, U32, Rw).value(0x60600008),
      object(0x1601, 3, U32, Rw).value(0),
      object(0x1601, 4, U32, Rw).value(0),
      object(0x1601, 5, U32, Rw).value(0),
      object(0x1601, 6, U32, Rw).value(0),
      object(0x1601, 7, U32, Rw).value(0),
      object(0x1601, 8, U32, Rw).value(0),
      object(0x1602, 0, U8, Rw).value(2).range(0, 8),
      object(0x1602, 1, U32, Rw).value(0x60400010),
      object(0x1602, 2, U32, Rw).value(0x607A0020),
      object(0x1602, 3, U32, Rw).value(0),
      object(0x1602, 4, U32, Rw).value(0),
      object(0x1602, 5, U32, Rw).value(0),
      object(0x1602, 6, U32, Rw).value(0),
      object(0x1602, 7, U32, Rw).value(0),
      object(0x1602, 8, U32, Rw).value(0),
      object(0x1603, 0, U8, Rw).value(2).range(0, 8),
      object(0x1603, 1, U32, Rw).value(0x60400010),
      object(0x1603, 2, U32, Rw).value(0x60FF0020),
      object(0x1603, 3, U32, Rw).value(0),
      object(0x1603, 4, U32, Rw).value(0),
      object(0x1603, 5, U32, Rw).value(0),
      object(0x1603, 6, U32, Rw).value(0),
      object(0x1603, 7, U32, Rw).value(0),
      object(0x1603, 8, U32, Rw).value(0),
      object(0x1800, 0, U8, Ro).value(3),
      object(0x1800, 1, U32, Rw).plus_node(0x40000180),
      object(0x1800, 2, U8, Rw).value(255),
      object(0x1800, 3, U16, Rw).value(10),
      object(0x1801, 0, U8, Ro).value(3),
      object(0x1801, 1, U32, Rw).plus_node(0xC0000280),
      object(0x1801, 2, U8, Rw).value(255),
      object(0x1801, 3, U16, Rw).value(10),
      object(0x1802, 0, U8, Ro).value(3),
      object(0x1802, 1, U32, Rw).plus_node(0xC0000380),
      object(0x1802, 2, U8, Rw).value(255),
      object(0x1802, 3, U16, Rw).value(10),
      object(0x1803, 0, U8, Ro).value(3),
      object(0x1803, 1, U32, Rw).plus_node(0xC0000480),
      object(0x1803, 2, U8, Rw).value(255),
      object(0x1803, 3, U16, Rw).value(10),
      object(0x1A00, 0, U8, Rw).value(1).range(0, 8),
      object(0x1A00, 1, U32, Rw).value(0x60410010),
      object(0x1A00, 2, U32, Rw).value(0),
      object(0x1A00, 3, U32, Rw).value(0),
      object(0x1A00, 4, U32, Rw).value(0),
      object(0x1A00, 5, U32, Rw).value(0),
      object(0x1A00, 6, U32, Rw).value(0),
      object(0x1A00, 7, U32, Rw).value(0),
      object(0x1A00, 8, U32, Rw).value(0),
      object(0x1A01, 0, U8, Rw).value(2).range(0, 8),
      object(0x1A01, 1, U32, Rw).value(0x60410010),
      object(0x1A01, 2, U32, Rw).value(0x60610008),
      object(0x1A01, 3, U32, Rw).value(0),
      object(0x1A01, 4, U32, Rw).value(0),
      object(0x1A01, 5, U32, Rw).value(0),
      object(0x1A01, 6, U32, Rw).value(0),
      object(0x1A01, 7, U32, Rw).value(0),
      object(0x1A01, 8, U32, Rw).value(0),
      object(0x1A02, 0, U8, Rw).value(2).range(0, 8),
      object(0x1A02, 1, U32, Rw).value(0x60410010),
      object(0x1A02, 2, U32, Rw).value(0x60640020),
      object(0x1A02, 3, U32, Rw).value(0),
      object(0x1A02, 4, U32, Rw).value(0),
      object(0x1A02, 5, U32, Rw).value(0),
      object(0x1A02, 6, U32, Rw).value(0),
      object(0x1A02, 7, U32, Rw).value(0),
      object(0x1A02, 8, U32, Rw).value(0),
      object(0x1A03, 0, U8, Rw).value(2).range(0, 8),
      object(0x1A03, 1, U32, Rw).value(0x60410010),
      object(0x1A03, 2, U32, Rw).value(0x606C0020),
      object(0x1A03, 3, U32, Rw).value(0),
      object(0x1A03, 4, U32, Rw).value(0),
      object(0x1A03, 5, U32, Rw).value(0),
      object(0x1A03, 6, U32, Rw).value(0),
      object(0x1A03, 7, U32, Rw).value(0),
      object(0x1A03, 8, U32, Rw).value(0),
      object(0x2062, 0, I32, Rww).pdo(),
      object(0x20C1, 0, U64, Wo).value(0).pdo(),
      object(0x20C4, 0, U8, Ro).value(3),
      object(0x20C4, 1, U16, Ro).pdo(),
      object(0x20C4, 2, U16, Rw).value(4).range(0, 63),
      object(0x20C4, 3, U16, Rw).value(60).range(1, 64),
      object(0x20F4, 0, I16, Ro).pdo(),
      object(0x6007, 0, I16, Rw),
      object(0x6040, 0, U16, Rww).pdo(),
      object(0x6041, 0, U16, Ro).pdo(),
      object(0x605B, 0, I16, Rw).value(0),
      object(0x605C, 0, I16, Rw).value(1),
      object(0x605E, 0, I16, Rw).value(2),
      object(0x6060, 0, I8, Rww).value(1).pdo(),
      object(0x6061, 0, I8, Ro).pdo(),
      object(0x6062, 0, I32, Ro).pdo(),
      object(0x6064, 0, I32, Ro).pdo(),
      object(0x6065, 0, U32, Rww).value(2000).pdo(),
      object(0x6067, 0, U32, Rw).value(0xFFFFFFFF),
      object(0x6068, 0, U16, Rw).value(0),
      object(0x6069, 0, I32, Ro).pdo(),
      object(0x606B, 0, I32, Ro).pdo(),
      object(0x606C, 0, I32, Ro).pdo(),
      object(0x607A, 0, I32, Rww).pdo(),
      object(0x607C, 0, I32, Rww).value(0).pdo(),
      object(0x607D, 0, U8, Const).value(2),
      object(0x607D, 1, I32, Rw).value(INT32_MIN),
      object(0x607D, 2, I32, Rw).value(INT32_MAX),
      object(0x607F, 0, U32, Rw).value(25000).range(0, 25000),
      object(0x6081, 0, U32, Rww).value(1000).pdo(),
      object(0x6083, 0, U32, Rww).value(10000).pdo(),
      object(0x6084, 0, U32, Rww).value(10000).pdo(),
      object(0x6085, 0, U32, Rww).value(10000).pdo(),
      object(0x6086, 0, I16, Rww).value(0).pdo(),
      object(0x6089, 0, I8, Rw).value(0),
      object(0x608A, 0, U8, Rw).value(0xAC),
      object(0x608B, 0, I8, Rw).value(0),
      object(0x608C, 0, U8, Rw).value(0xA4),
      object(0x608D, 0, I8, Rw).value(0),
      object(0x608E, 0, U8, Rw).value(0xA4),
      object(0x60C0, 0, I16, Rw).value(-1).range(-1, -1),
      object(0x60C2, 0, U8, Const).value(2),
      object(0x60C2, 1, U8, Rw).value(1).range(1, 1),
      object(0x60C2, 2, I8, Rw).value(-3).range(-3, -3),
      object(0x60C4, 0, U8, Const).value(6),
      object(0x60C4, 1, U32, Ro),
      object(0x60C4, 2, U32, Ro),
      object(0x60C4, 3, U8, Rw).value(0).range(0, 0),
      object(0x60C4, 4, U16, Rw).value(0).range(0, 64),
      object(0x60C4, 5, U8, Wo).value(8).range(8, 8),
      object(0x60C4, 6, U8, Wo).value(0).range(0, 1).pdo(),
      object(0x60C5, 0, U32, Rw).value(0xFFFFFFFF),
      object(0x60FF, 0, I32, Rww).pdo(),
      object(0x6402, 0, U16, Rw).value(10),
      object(0x6410, 0, U8, Const).value(5),
      object(0x6410, 1, U16, Rww).value(10000).range(0, 10000).pdo(),
      object(0x6410, 2, U16, Rww).value(25000).range(0, 25000).pdo(),
      object(0x6410, 3, U8, Rw).value(1),
      object(0x6410, 4, U32, Rww).value(25000).pdo(),
      object(0x6410, 5, U16, Rw).value(40).range(1, 5400),
      object(0x6502, 0, U32, Ro),
  };
}();

/// Row of an object in kEposObjects; the size of the table when there is none.
constexpr std::size_t object_slot(std::uint16_t index, std::uint8_t subindex) {
  std::size_t low = 0;
  std::size_t high = kEposObjects.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    const ObjectEntry& entry = kEposObjects[middle];
    const bool before = entry.index < index || (entry.index == index && entry.subindex < subindex);
    (before ? low : high) = before ? middle + 1 : middle;
  }
  const bool found =
      low < kEposObjects.size() && kEposObjects[low].index == index && kEposObjects[low].subindex == subindex;
  return found ? low : kEposObjects.size();
}

/// Row of an object that is known to exist.
template <std::uint16_t index, std::uint8_t subindex>
inline constexpr std::size_t kObject = [] {
  constexpr std::size_t slot = object_slot(index, subindex);
  static_assert(slot < kEposObjects.size(), "no such object in the table");
  return slot;
}();

}  // namespace interpolated_motion::emulation
