#pragma once

#include <cstdint>

namespace interpolated_motion::emulation {

/// Data types of objects, with the numbers of CiA 301.
enum class ObjectType : std::uint8_t {
  I8 = 2,
  I16 = 3,
  I32 = 4,
  U8 = 5,
  U16 = 6,
  U32 = 7,
  String = 9,
  U64 = 0x1B
};

/// Access as an EDS file states it (CiA 306).
enum class Access : std::uint8_t { Ro, Wo, Rw, Rww, Const };

/// Bytes of a value of this type; 0 for a string.
constexpr int size_of(ObjectType type) {
  switch (type) {
    case ObjectType::I8:
    case ObjectType::U8:
      return 1;
    case ObjectType::I16:
    case ObjectType::U16:
      return 2;
    case ObjectType::I32:
    case ObjectType::U32:
      return 4;
    case ObjectType::U64:
      return 8;
    case ObjectType::String:
      return 0;
  }
  return 0;
}

/// Whether the type has a sign; a string has none.
constexpr bool is_signed(ObjectType type) {
  return type == ObjectType::I8 || type == ObjectType::I16 || type == ObjectType::I32;
}

/// One row of the object table: what an EDS says about an object.
struct ObjectEntry {
  std::uint16_t index = 0;           ///< 0x1000.. CiA 301, 0x2000.. the vendor's, 0x6000.. CiA 402
  std::uint8_t subindex = 0;         ///< 0 for a variable, or for the number of entries
  ObjectType type = ObjectType::U8;  ///< decides the size of the value on the wire
  Access access = Access::Ro;        ///< by SDO; Rww is as Rw: for PDOs `mappable` decides
  bool mappable = false;             ///< may be mapped into a PDO
  bool has_default = false;          ///< the EDS states a default
  bool plus_node_id = false;         ///< the node id is added to the default
  bool has_range = false;            ///< `low` and `high` hold
  std::int64_t initial = 0;          ///< default value
  std::int64_t low = 0;              ///< included
  std::int64_t high = 0;             ///< included

  /// By SDO; else the access is aborted with 0x06010001 or 0x06010002.
  constexpr bool readable() const { return access != Access::Wo; }
  constexpr bool writable() const { return access != Access::Ro && access != Access::Const; }

  /// The same row with the default `v`.
  constexpr ObjectEntry value(std::int64_t v) const {
    ObjectEntry entry = *this;
    entry.has_default = true;
    entry.initial = v;
    return entry;
  }
  /// The same row with the default `v` plus the node id, as `$NODEID+v` of an EDS.
  constexpr ObjectEntry plus_node(std::int64_t v) const {
    ObjectEntry entry = value(v);
    entry.plus_node_id = true;
    return entry;
  }
  /// The same row with a range, both ends included; a write outside of it is aborted.
  constexpr ObjectEntry range(std::int64_t lowest, std::int64_t highest) const {
    ObjectEntry entry = *this;
    entry.has_range = true;
    entry.low = lowest;
    entry.high = highest;
    return entry;
  }
  /// The same row, which may be mapped into a PDO.
  constexpr ObjectEntry pdo() const {
    ObjectEntry entry = *this;
    entry.mappable = true;
    return entry;
  }
};

}  // namespace interpolated_motion::emulation
