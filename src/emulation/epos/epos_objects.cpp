#include "interpolated_motion_driver/emulation/epos/epos_objects.h"

namespace interpolated_motion::emulation {
namespace {

// 0x1000: servo drive (2), device profile 402 (0x192).
constexpr std::int64_t kDeviceType = 0x00020192;
// 0x6502: profile position, profile velocity, homing and interpolated position mode (CiA 402 bits 0, 2, 5,
// 6). EPOS4: cyclic synchronous position, velocity and torque in its place (bits 7, 8, 9).
constexpr std::int64_t kModesWithInterpolation = 0x65;
constexpr std::int64_t kModesWithoutInterpolation = 0x3A5;
constexpr std::int64_t kBufferCapacity = 64;

}  // namespace

EposObjects::EposObjects(const EposParameters& parameters)
    : ObjectDictionary({kEposObjects.data(), kEposObjects.size()}, parameters.node_id),
      parameters_(parameters) {
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
}

bool EposObjects::hidden(std::uint16_t index) const {
  if (parameters_.variant == EposVariant::Epos2) return false;
  return index == 0x20C1 || index == 0x20C4 || index == 0x60C0 || index == 0x60C4;
}

std::int64_t EposObjects::notation_scale() const {
  std::int64_t scale = 1;
  for (std::int64_t notation = get(kObject<0x608B, 0>); notation < 0; ++notation) scale *= 10;
  return scale;
}

AbortCode EposObjects::check_range(Slot slot, std::int64_t value) const {
  const ObjectEntry& row = entry(slot);
  const bool notation = row.index == 0x608B || row.index == 0x608D;
  if (notation) return check_between(static_cast<int>(parameters_.lowest_velocity_notation), value, 0);
  if (!row.has_range) return AbortCode::None;
  const bool scales = row.index == 0x607F && parameters_.limit_ranges_scale_with_notation;
  return check_between(row.low, value, scales ? row.high * notation_scale() : row.high);
}

bool EposObjects::mappable(Slot slot, bool into_receive_pdo) const {
  const ObjectEntry& row = entry(slot);
  if (row.index == 0x60C4 && row.subindex == 2) {
    return parameters_.free_records_pdo_mappable && !into_receive_pdo;
  }
  if (row.index == 0x60C4 && row.subindex == 6) {
    return parameters_.buffer_clear_pdo_mappable && into_receive_pdo;
  }
  if (row.index == 0x1013 && !parameters_.time_stamp_pdo_mappable) return false;
  return ObjectDictionary::mappable(slot, into_receive_pdo);
}

}  // namespace interpolated_motion::emulation
