#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "interpolated_motion_driver/emulation/abort_code.h"
#include "interpolated_motion_driver/emulation/epos_object_table.h"
#include "interpolated_motion_driver/emulation/epos_parameters.h"

namespace interpolated_motion::emulation {

/// Values of the objects of one drive, and the checks every access goes through. Values are kept as numbers,
/// sign-extended; an unsigned 64-bit value keeps its bits.
class ObjectDictionary {
 public:
  using Slot = std::size_t;
  using Values = std::array<std::int64_t, kEposObjects.size()>;
  static constexpr Slot kNone = kEposObjects.size();

  explicit ObjectDictionary(const EposParameters& parameters);

  /// Row of an object of this drive, kNone when it has none.
  Slot find(std::uint16_t index, std::uint8_t subindex) const;

  /// Why there is no such object: NoSuchObject or NoSuchSubindex.
  AbortCode why_missing(std::uint16_t index) const;

  /// Value at power-up if nothing has been stored: the default of the EDS, or that of the drive's parameters.
  const Values& defaults() const { return defaults_; }

  std::int64_t get(Slot slot) const { return values_[slot]; }
  void set(Slot slot, std::int64_t value) { values_[slot] = value; }

  /// The low bytes of the value as they go on the wire.
  std::uint64_t raw(Slot slot) const;

  const Values& values() const { return values_; }
  void restore(const Values& values) { values_ = values; }

  /// Whether `size` bytes holding `raw` may be written: access, length, range. None: yes; `value` is the
  /// number then.
  AbortCode check_write(Slot slot, std::size_t size, std::uint64_t raw, std::int64_t& value) const;

  /// Whether an object may be mapped into a PDO of the given direction.
  bool mappable(Slot slot, bool into_receive_pdo) const;

 private:
  bool hidden(std::uint16_t index) const;
  AbortCode check_range(Slot slot, std::int64_t value) const;
  /// How many of the unit of 0x608B make an rpm.
  std::int64_t notation_scale() const;

  const EposParameters& parameters_;
  Values defaults_{};
  Values values_{};
};

/// Number encoded by the low bytes of `raw` for this type.
std::int64_t decode(ObjectType type, std::uint64_t raw);

}  // namespace interpolated_motion::emulation
