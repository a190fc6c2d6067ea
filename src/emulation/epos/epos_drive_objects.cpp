#include <cmath>

#include "epos_drive_implementation.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::uint32_t kSaveSignature = 0x65766173;     // "save", CiA 301 object 1010h
constexpr std::uint32_t kRestoreSignature = 0x64616F6C;  // "load", CiA 301 object 1011h
constexpr std::uint8_t kRestoreCobIds = 5;               // sub-index of 1011h

constexpr int kInterpolatedPositionMode = 7;

constexpr double kMillisecondsPerMinute = 60e3;

// Objects that are not parameters: commands and process values, which start at their defaults.
bool is_volatile(std::uint16_t index) {
  switch (index) {
    case 0x1003:
    case 0x1010:
    case 0x1011:
    case 0x1013:
    case 0x20C1:
    case 0x2062:
    case 0x6040:
    case 0x607A:
    case 0x60C4:
    case 0x60FF:
      return true;
    default:
      return false;
  }
}

bool changes_limits(std::uint16_t index) {
  switch (index) {
    case 0x20C4:
    case 0x607D:
    case 0x607F:
    case 0x6081:
    case 0x6083:
    case 0x6084:
    case 0x6085:
    case 0x608B:
    case 0x608D:
    case 0x60C5:
      return true;
    default:
      return false;
  }
}

bool mode_exists(EposVariant variant, std::int64_t mode) {
  if (variant == EposVariant::Epos4) return mode == 1 || mode == 3 || mode == 6 || (mode >= 8 && mode <= 10);
  return (mode >= -6 && mode <= -1) || mode == 1 || mode == 3 || mode == 6 || mode == 7;
}

}  // namespace

ObjectDictionary::Values EposDrive::Implementation::initial_values() const {
  ObjectDictionary::Values values = objects_.defaults();
  if (!stored_) return values;
  for (ObjectDictionary::Slot slot = 0; slot < values.size(); ++slot) {
    const ObjectEntry& entry = kEposObjects[slot];
    if (entry.writable() && !is_volatile(entry.index)) values[slot] = (*stored_)[slot];
  }
  return values;
}

AbortCode EposDrive::Implementation::check_value(const ObjectEntry& entry, std::int64_t value) const {
  switch (entry.index) {
    case 0x1010:
      return value == kSaveSignature ? AbortCode::None : AbortCode::CannotStore;
    case 0x1011:
      return value == kRestoreSignature ? AbortCode::None : AbortCode::CannotStore;
    case 0x6060:
      return mode_exists(parameters_.variant, value) ? AbortCode::None : AbortCode::ValueRange;
    default:
      return AbortCode::None;
  }
}

std::optional<AbortCode> EposDrive::Implementation::divert(const ObjectEntry& entry, std::uint64_t raw) {
  if (entry.index != 0x20C1) return std::nullopt;
  return take_record(raw);
}

void EposDrive::Implementation::written(const ObjectEntry& entry, std::int64_t value) {
  if (changes_limits(entry.index)) return update_limits();
  switch (entry.index) {
    case 0x1010:
      store_parameters();
      return objects_.set(object_slot(entry.index, entry.subindex), 1);
    case 0x1011:
      return restore_parameters(entry.subindex);
    case 0x1013:
      return clock().take_time_stamp(static_cast<std::uint32_t>(value));
    case 0x6040:
      return controlword(static_cast<std::uint16_t>(value));
    case 0x6060:
      return select_mode(static_cast<int>(value));
    case 0x60C4:
      if (entry.subindex == 6) ip_.enable_access(value != 0);
      return;
    default:
      return;
  }
}

void EposDrive::Implementation::restore_parameters(std::uint8_t subindex) {
  subindex == kRestoreCobIds ? restore_cob_ids() : stored_.reset();
  objects_.set(object_slot(0x1011, subindex), 1);
}

void EposDrive::Implementation::restore_cob_ids() {
  for (ObjectDictionary::Slot slot = 0; slot < kEposObjects.size(); ++slot) {
    const ObjectEntry& entry = kEposObjects[slot];
    const bool communication = PdoEngine::concerns(entry.index) && (entry.index & 0x0200) == 0;
    if (communication && entry.subindex == 1) objects_.set(slot, objects_.defaults()[slot]);
  }
  configure_pdos();
}

RecordPolicy EposDrive::Implementation::record_policy() const {
  if (!ip_.access_enabled()) return parameters_.records_while_access_disabled;
  if (mode() != kInterpolatedPositionMode) return parameters_.records_outside_mode;
  if (!device_.operation_enabled()) return parameters_.records_outside_operation_enabled;
  return RecordPolicy::Accept;
}

AbortCode EposDrive::Implementation::take_record(std::uint64_t raw) {
  const RecordPolicy policy = record_policy();
  if (policy != RecordPolicy::Accept) {
    ++counters_.records_refused;
    return policy == RecordPolicy::Abort ? AbortCode::DeviceState : AbortCode::None;
  }
  const int before = ip_.fill();
  const InterpolationEvent event = ip_.push(BufferedRecord::from_raw(raw));
  ++(ip_.fill() > before ? counters_.records_accepted : counters_.records_refused);
  handle(event);
  publish_status();
  return is_error(event) ? AbortCode::DeviceState : AbortCode::None;
}

void EposDrive::Implementation::update_limits() {
  const auto value = [this](std::uint16_t index, std::uint8_t subindex) {
    return static_cast<double>(objects_.get(object_slot(index, subindex)));
  };
  // One rpm in qc/ms, one rpm/s in qc/ms^2.
  const double rpm = parameters_.counts_per_revolution / kMillisecondsPerMinute;
  const double notation = std::pow(10.0, value(0x608B, 0));
  const double velocity = rpm * (parameters_.limits_scale_with_notation ? notation : 1.0);
  const double acceleration = rpm * 1e-3 * std::pow(10.0, value(0x608D, 0));
  InterpolationLimits limits;
  limits.velocity_unit = rpm * notation;
  limits.velocity_warning = value(0x6081, 0) * velocity;
  limits.velocity_error = value(0x607F, 0) * velocity;
  limits.acceleration_warning = value(0x6083, 0) * acceleration;
  limits.acceleration_error = value(0x60C5, 0) * acceleration;
  limits.lowest_position = value(0x607D, 1);
  limits.highest_position = value(0x607D, 2);
  limits.underflow_level = static_cast<int>(value(0x20C4, 2));
  limits.overflow_level = static_cast<int>(value(0x20C4, 3));
  ip_.set_limits(limits);
  profile_deceleration_ = value(0x6084, 0) * acceleration;
  quick_stop_deceleration_ = value(0x6085, 0) * acceleration;
  velocity_units_ = 1.0 / velocity;
}

}  // namespace interpolated_motion::emulation
