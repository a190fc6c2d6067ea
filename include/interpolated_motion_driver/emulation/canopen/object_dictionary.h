#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpolated_motion_driver/emulation/canopen/abort_code.h"
#include "interpolated_motion_driver/emulation/canopen/object_table.h"

namespace interpolated_motion::emulation {

/// Values of the objects of one drive, and the checks every access goes through. Values are kept as numbers,
/// sign-extended; an unsigned 64-bit value keeps its bits. A kind of drive derives its own from it, with its
/// table, its presets and its exceptions.
class ObjectDictionary {
 public:
  using Slot = std::size_t;
  using Values = std::vector<std::int64_t>;
  static constexpr Slot kNone = SIZE_MAX;  ///< no row: for nothing but comparing

  virtual ~ObjectDictionary() = default;

  /// Row of an object of this drive, kNone when it has none.
  Slot find(std::uint16_t index, std::uint8_t subindex) const;

  /// The row itself.
  const ObjectEntry& entry(Slot slot) const { return table_.rows[slot]; }
  /// Rows of the table, those this drive does not have included.
  Slot size() const { return table_.size; }

  /// Why there is no such object: NoSuchObject or NoSuchSubindex.
  AbortCode why_missing(std::uint16_t index) const;

  /// Value at power-up if nothing has been stored: the default of the EDS, or that of the drive's parameters.
  const Values& defaults() const { return defaults_; }

  /// The value of a row of this table, as a number. Setting checks nothing and tells nobody.
  std::int64_t get(Slot slot) const { return values_[slot]; }
  void set(Slot slot, std::int64_t value) { values_[slot] = value; }

  /// The same for an object that exists.
  std::int64_t get(std::uint16_t index, std::uint8_t subindex) const { return get(find(index, subindex)); }
  void set(std::uint16_t index, std::uint8_t subindex, std::int64_t value) {
    set(find(index, subindex), value);
  }

  /// The low bytes of the value as they go on the wire.
  std::uint64_t raw(Slot slot) const;

  /// The values of all rows in the order of the table, to be stored and to be set again.
  const Values& values() const { return values_; }
  void restore(const Values& values) { values_ = values; }

  /// Whether `size` bytes holding `raw` may be written: access, length, range. None: yes; `value` is the
  /// number then.
  AbortCode check_write(Slot slot, std::size_t size, std::uint64_t raw, std::int64_t& value) const;

  /// Whether an object may be mapped into a PDO of the given direction.
  virtual bool mappable(Slot slot, bool into_receive_pdo) const;

 protected:
  /// Defaults of the table, `node_id` added where it says so.
  ObjectDictionary(ObjectTable table, std::uint8_t node_id);

  /// Gives an object that exists a default of the drive's own. For constructors.
  void preset(std::uint16_t index, std::uint8_t subindex, std::int64_t value);

 private:
  /// Objects of the table this drive does not have.
  virtual bool hidden(std::uint16_t index) const;
  virtual AbortCode check_range(Slot slot, std::int64_t value) const;

  ObjectTable table_;
  Values defaults_;
  Values values_;
};

/// TooHigh, TooLow or None.
AbortCode check_between(std::int64_t low, std::int64_t value, std::int64_t high);

/// Number encoded by the low bytes of `raw` for this type.
std::int64_t decode(ObjectType type, std::uint64_t raw);

}  // namespace interpolated_motion::emulation
