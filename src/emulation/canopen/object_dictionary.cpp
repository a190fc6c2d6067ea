#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"

namespace interpolated_motion::emulation {
namespace {

std::uint64_t low_bytes(std::uint64_t raw, int size) {
  return size >= 8 ? raw : raw & ((std::uint64_t{1} << (8 * size)) - 1);
}

}  // namespace

std::int64_t decode(ObjectType type, std::uint64_t raw) {
  switch (type) {
    case ObjectType::I8:
      return static_cast<std::int8_t>(raw);
    case ObjectType::I16:
      return static_cast<std::int16_t>(raw);
    case ObjectType::I32:
      return static_cast<std::int32_t>(raw);
    default:
      return static_cast<std::int64_t>(low_bytes(raw, size_of(type)));
  }
}

AbortCode check_between(std::int64_t low, std::int64_t value, std::int64_t high) {
  if (value > high) return AbortCode::ValueTooHigh;
  return value < low ? AbortCode::ValueTooLow : AbortCode::None;
}

ObjectDictionary::ObjectDictionary(ObjectTable table, std::uint8_t node_id)
    : table_(table), defaults_(table.size) {
  for (Slot slot = 0; slot < table_.size; ++slot) {
    const ObjectEntry& row = table_.rows[slot];
    defaults_[slot] = row.initial + (row.plus_node_id ? node_id : 0);
  }
  values_ = defaults_;
}

void ObjectDictionary::preset(std::uint16_t index, std::uint8_t subindex, std::int64_t value) {
  const Slot slot = table_.slot(index, subindex);
  defaults_[slot] = value;
  values_[slot] = value;
}

bool ObjectDictionary::hidden(std::uint16_t /*index*/) const { return false; }

ObjectDictionary::Slot ObjectDictionary::find(std::uint16_t index, std::uint8_t subindex) const {
  const Slot slot = table_.slot(index, subindex);
  return slot == table_.size || hidden(index) ? kNone : slot;
}

AbortCode ObjectDictionary::why_missing(std::uint16_t index) const {
  const bool exists = find(index, 0) != kNone;
  return exists ? AbortCode::NoSuchSubindex : AbortCode::NoSuchObject;
}

std::uint64_t ObjectDictionary::raw(Slot slot) const {
  return low_bytes(static_cast<std::uint64_t>(values_[slot]), size_of(entry(slot).type));
}

AbortCode ObjectDictionary::check_write(Slot slot, std::size_t size, std::uint64_t raw,
                                        std::int64_t& value) const {
  const ObjectEntry& row = entry(slot);
  if (!row.writable()) return AbortCode::ReadOnly;
  const auto expected = static_cast<std::size_t>(size_of(row.type));
  if (size > expected) return AbortCode::TooLong;
  if (size < expected) return AbortCode::TooShort;
  value = decode(row.type, raw);
  return check_range(slot, value);
}

AbortCode ObjectDictionary::check_range(Slot slot, std::int64_t value) const {
  const ObjectEntry& row = entry(slot);
  return row.has_range ? check_between(row.low, value, row.high) : AbortCode::None;
}

bool ObjectDictionary::mappable(Slot slot, bool into_receive_pdo) const {
  const ObjectEntry& row = entry(slot);
  if (!row.mappable) return false;
  return into_receive_pdo ? row.writable() : row.readable();
}

}  // namespace interpolated_motion::emulation
