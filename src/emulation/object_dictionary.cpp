#include "interpolated_motion_driver/emulation/object_dictionary.h"

namespace interpolated_motion::emulation {
namespace {

// 0x1000: servo drive (2), device profile 402 (0x192).
constexpr std::int64_t kDeviceType = 0x00020192;
// 0x6502: profile position, profile velocity, homing and interpolated position mode (CiA 402 bits 0, 2, 5,
// 6).
constexpr std::int64_t kModesWithInterpolation = 0x65;
constexpr std::int64_t kModesWithoutInterpolation = 0x25;
constexpr std::int64_t kBufferCapacity = 64;

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

ObjectDictionary::ObjectDictionary(const EposParameters& parameters) : parameters_(parameters) {
  for (Slot slot = 0; slot < kEposObjects.size(); ++slot) {
    const ObjectEntry& entry = kEposObjects[slot];
    defaults_[slot] = entry.initial + (entry.plus_node_id ? parameters.node_id : 0);
  }
  const auto preset = [this](std::uint16_t index, std::uint8_t subindex, std::int64_t value) {
    defaults_[object_slot(index, subindex)] = value;
  };
  const bool interpolating = parameters.variant == EposVariant::Epos2;
  preset(0x1000, 0, kDeviceType);
  preset(0x1010, 1, 1);
  preset(0x1011, 1, 1);
  preset(0x1011, 4, 1);
  preset(0x1011, 5, 1);
  preset(0x1018, 1, parameters.vendor_id);
  preset(0x1018, 2, parameters.product_code);
  preset(0x1018, 3, parameters.revision_number);
  preset(0x1018, 4, parameters.serial_number);
  preset(0x6007, 0, parameters.abort_connection_option);
  preset(0x605E, 0, parameters.fault_reaction_option);
  preset(0x60C4, 1, kBufferCapacity);
  preset(0x60C4, 2, kBufferCapacity);
  preset(0x6502, 0, interpolating ? kModesWithInterpolation : kModesWithoutInterpolation);
  values_ = defaults_;
}

bool ObjectDictionary::hidden(std::uint16_t index) const {
  if (parameters_.variant == EposVariant::Epos2) return false;
  return index == 0x20C1 || index == 0x20C4 || index == 0x60C0 || index == 0x60C4;
}

ObjectDictionary::Slot ObjectDictionary::find(std::uint16_t index, std::uint8_t subindex) const {
  return hidden(index) ? kNone : object_slot(index, subindex);
}

AbortCode ObjectDictionary::why_missing(std::uint16_t index) const {
  const bool exists = find(index, 0) != kNone;
  return exists ? AbortCode::NoSuchSubindex : AbortCode::NoSuchObject;
}

std::uint64_t ObjectDictionary::raw(Slot slot) const {
  return low_bytes(static_cast<std::uint64_t>(values_[slot]), size_of(kEposObjects[slot].type));
}

AbortCode ObjectDictionary::check_write(Slot slot, std::size_t size, std::uint64_t raw,
                                        std::int64_t& value) const {
  const ObjectEntry& entry = kEposObjects[slot];
  if (!entry.writable()) return AbortCode::ReadOnly;
  const auto expected = static_cast<std::size_t>(size_of(entry.type));
  if (size > expected) return AbortCode::TooLong;
  if (size < expected) return AbortCode::TooShort;
  value = decode(entry.type, raw);
  return check_range(slot, value);
}

std::int64_t ObjectDictionary::notation_scale() const {
  std::int64_t scale = 1;
  for (std::int64_t notation = get(find(0x608B, 0)); notation < 0; ++notation) scale *= 10;
  return scale;
}

AbortCode ObjectDictionary::check_range(Slot slot, std::int64_t value) const {
  const ObjectEntry& entry = kEposObjects[slot];
  std::int64_t low = entry.low;
  std::int64_t high = entry.high;
  const bool notation = entry.index == 0x608B || entry.index == 0x608D;
  if (notation) {
    low = static_cast<int>(parameters_.lowest_velocity_notation);
    high = 0;
  }
  if (!notation && !entry.has_range) return AbortCode::None;
  if (entry.index == 0x607F && parameters_.limit_ranges_scale_with_notation) high *= notation_scale();
  if (value > high) return AbortCode::ValueTooHigh;
  return value < low ? AbortCode::ValueTooLow : AbortCode::None;
}

bool ObjectDictionary::mappable(Slot slot, bool into_receive_pdo) const {
  const ObjectEntry& entry = kEposObjects[slot];
  if (entry.index == 0x60C4 && entry.subindex == 2) {
    return parameters_.free_records_pdo_mappable && !into_receive_pdo;
  }
  if (entry.index == 0x60C4 && entry.subindex == 6) {
    return parameters_.buffer_clear_pdo_mappable && into_receive_pdo;
  }
  if (entry.index == 0x1013 && !parameters_.time_stamp_pdo_mappable) return false;
  if (!entry.mappable) return false;
  return into_receive_pdo ? entry.writable() : entry.readable();
}

}  // namespace interpolated_motion::emulation
