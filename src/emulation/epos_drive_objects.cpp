#include <algorithm>
#include <cmath>

#include "epos_drive_implementation.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::uint32_t kSaveSignature = 0x65766173;     // "save", CiA 301 object 1010h
constexpr std::uint32_t kRestoreSignature = 0x64616F6C;  // "load", CiA 301 object 1011h

constexpr int kInterpolatedPositionMode = 7;

constexpr unsigned kHalt = 1U << 8;
constexpr unsigned kEnableIpMode = 1U << 4;

constexpr std::uint16_t kRemote = 1U << 9;
constexpr std::uint16_t kTargetReached = 1U << 10;
constexpr std::uint16_t kIpActive = 1U << 12;
constexpr std::uint16_t kHomed = 1U << 15;
constexpr std::int64_t kNoWindow = 0xFFFFFFFF;

constexpr std::uint16_t kInterpolationError = 0xFF0C;
constexpr std::uint16_t kPositionLimitError = 0xFF09;

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
  return (mode >= -6 && mode <= -1) || mode == 1 || mode == 3 || (mode >= 6 && mode <= 8);
}

std::uint64_t raw_value(const std::uint8_t* data, std::size_t size) {
  std::uint64_t raw = 0;
  for (std::size_t i = 0; i < size && i < 8; ++i) raw |= static_cast<std::uint64_t>(data[i]) << (8 * i);
  return raw;
}

}  // namespace

AbortCode EposDrive::Implementation::sdo_read(std::uint16_t index, std::uint8_t subindex,
                                              std::array<std::uint8_t, kSdoCapacity>& data,
                                              std::size_t& size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  const ObjectEntry& entry = kEposObjects[slot];
  if (!entry.readable()) return AbortCode::WriteOnly;
  if (entry.type == ObjectType::String) {
    size = parameters_.device_name.size();
    std::copy(parameters_.device_name.begin(), parameters_.device_name.end(), data.begin());
    return AbortCode::None;
  }
  size = static_cast<std::size_t>(size_of(entry.type));
  const std::uint64_t raw = objects_.raw(slot);
  for (std::size_t i = 0; i < size; ++i) data[i] = static_cast<std::uint8_t>(raw >> (8 * i));
  return AbortCode::None;
}

AbortCode EposDrive::Implementation::sdo_writable(std::uint16_t index, std::uint8_t subindex,
                                                  std::size_t& object_size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  object_size = static_cast<std::size_t>(size_of(kEposObjects[slot].type));
  return kEposObjects[slot].writable() ? AbortCode::None : AbortCode::ReadOnly;
}

AbortCode EposDrive::Implementation::sdo_write(std::uint16_t index, std::uint8_t subindex,
                                               const std::uint8_t* data, std::size_t size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  return write(slot, size, raw_value(data, size));
}

void EposDrive::Implementation::pdo_write(ObjectDictionary::Slot slot, std::uint64_t raw) {
  // A value the drive refuses is lost: a PDO has no answer to carry an abort code.
  static_cast<void>(write(slot, static_cast<std::size_t>(size_of(kEposObjects[slot].type)), raw));
}

AbortCode EposDrive::Implementation::write(ObjectDictionary::Slot slot, std::size_t size, std::uint64_t raw) {
  std::int64_t value = 0;
  AbortCode code = objects_.check_write(slot, size, raw, value);
  if (code == AbortCode::None) code = check_value(slot, value);
  if (code != AbortCode::None) return code;
  if (kEposObjects[slot].index == 0x20C1) return take_record(raw);
  objects_.set(slot, value);
  written(slot);
  publish_status();
  return AbortCode::None;
}

AbortCode EposDrive::Implementation::check_value(ObjectDictionary::Slot slot, std::int64_t value) const {
  const ObjectEntry& entry = kEposObjects[slot];
  if (PdoEngine::concerns(entry.index)) return pdo_.check(slot, value, nmt_.operational());
  switch (entry.index) {
    case 0x1003:
      return value == 0 ? AbortCode::None : AbortCode::ValueRange;
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

void EposDrive::Implementation::written(ObjectDictionary::Slot slot) {
  const ObjectEntry& entry = kEposObjects[slot];
  const std::int64_t value = objects_.get(slot);
  if (entry.index < 0x2000) return communication_written(entry.index, entry.subindex);
  if (changes_limits(entry.index)) return update_limits();
  switch (entry.index) {
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

void EposDrive::Implementation::communication_written(std::uint16_t index, std::uint8_t subindex) {
  if (PdoEngine::concerns(index)) return pdo_.configure();
  const std::int64_t value = objects_.get(object_slot(index, subindex));
  switch (index) {
    case 0x1003:
      errors_.clear_history();
      return publish_errors();
    case 0x1010:
      store_parameters();
      break;
    case 0x1011:
      if (subindex == 5) return restore_cob_ids();
      stored_.reset();
      break;
    case 0x1013:
      return clock_.take_time_stamp(static_cast<std::uint32_t>(value));
    case 0x1016:
      return nmt_.set_consumer(subindex - 1, static_cast<std::uint32_t>(value));
    case 0x1017:
      return nmt_.set_producer_time(static_cast<std::uint16_t>(value), milliseconds_);
    case 0x100C:
    case 0x100D:
      nmt_.set_life_time(objects_.get(kObject<0x100C, 0>) * objects_.get(kObject<0x100D, 0>));
      return;
    default:
      return;
  }
  objects_.set(object_slot(index, subindex), 1);
}

void EposDrive::Implementation::apply_communication_parameters() {
  pdo_.configure();
  communication_written(0x100C, 0);
  nmt_.set_consumer(0, static_cast<std::uint32_t>(objects_.get(kObject<0x1016, 1>)));
  nmt_.set_consumer(1, static_cast<std::uint32_t>(objects_.get(kObject<0x1016, 2>)));
  nmt_.set_producer_time(static_cast<std::uint16_t>(objects_.get(kObject<0x1017, 0>)), milliseconds_);
}

void EposDrive::Implementation::load_stored(bool communication_only) {
  ObjectDictionary::Values values = communication_only ? objects_.values() : objects_.defaults();
  for (ObjectDictionary::Slot slot = 0; slot < values.size(); ++slot) {
    const ObjectEntry& entry = kEposObjects[slot];
    if (communication_only && entry.index >= 0x2000) continue;
    const bool kept = stored_ && entry.writable() && !is_volatile(entry.index);
    values[slot] = kept ? (*stored_)[slot] : objects_.defaults()[slot];
  }
  objects_.restore(values);
  objects_.set(kObject<0x6061, 0>, objects_.get(kObject<0x6060, 0>));
}

void EposDrive::Implementation::restore_cob_ids() {
  for (ObjectDictionary::Slot slot = 0; slot < kEposObjects.size(); ++slot) {
    const ObjectEntry& entry = kEposObjects[slot];
    const bool communication = PdoEngine::concerns(entry.index) && (entry.index & 0x0200) == 0;
    if (communication && entry.subindex == 1) objects_.set(slot, objects_.defaults()[slot]);
  }
  objects_.set(kObject<0x1011, 5>, 1);
  pdo_.configure();
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

void EposDrive::Implementation::handle(InterpolationEvent event) {
  if (!is_error(event)) return;
  if (event == InterpolationEvent::PositionLimit) {
    fault(kPositionLimitError, parameters_.motion_error_register, now_);
  } else {
    fault(kInterpolationError, parameters_.interpolation_error_register, now_);
  }
}

void EposDrive::Implementation::controlword(std::uint16_t word) {
  const bool was_enabled = ip_bit_;
  ip_bit_ = (word & kEnableIpMode) != 0;
  halt_ = (word & kHalt) != 0;
  if (device_.command(word, option_codes())) {
    connection_error_ = false;
    ip_.on_fault_reset();
    send_emergency_bytes(errors_.reset());
    publish_errors();
  }
  const bool moving = device_.operation_enabled() && device_.ramp() == StopRamp::None;
  if (!moving) return stop_interpolation();
  if (mode() == kInterpolatedPositionMode) command_interpolation(ip_bit_, was_enabled);
}

void EposDrive::Implementation::command_interpolation(bool enabled, bool was_enabled) {
  if (enabled && !was_enabled) start_requested_ = true;
  if (!enabled) stop_interpolation();
}

void EposDrive::Implementation::stop_interpolation() {
  const bool was_active = ip_.active();
  start_requested_ = false;
  halted_ = false;
  ip_.stop();
  const bool commanded = device_.operation_enabled() && device_.ramp() == StopRamp::None;
  if (was_active && commanded && parameters_.active_stop == ActiveStop::AtOnce) stop_at_once();
}

void EposDrive::Implementation::select_mode(int selected) {
  const int before = mode();
  objects_.set(kObject<0x6061, 0>, selected);
  if (selected == before) return;
  if (before == kInterpolatedPositionMode) stop_interpolation();
  if (selected == kInterpolatedPositionMode) ip_.select();
}

int EposDrive::Implementation::mode() const { return static_cast<int>(objects_.get(kObject<0x6061, 0>)); }

OptionCodes EposDrive::Implementation::option_codes() const {
  OptionCodes options;
  options.shutdown = static_cast<std::int16_t>(objects_.get(kObject<0x605B, 0>));
  options.disable_operation = static_cast<std::int16_t>(objects_.get(kObject<0x605C, 0>));
  options.fault_reaction = static_cast<std::int16_t>(objects_.get(kObject<0x605E, 0>));
  return options;
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

std::uint16_t EposDrive::Implementation::statusword() const {
  unsigned word = device_.status_bits();
  if (nmt_.operational()) word |= kRemote;
  if (parameters_.homed) word |= kHomed;
  if (!device_.operation_enabled()) return static_cast<std::uint16_t>(word);
  if (ip_.active()) word |= kIpActive;
  const bool at_rest = demand_.velocity == 0.0;
  const bool windowed = objects_.get(kObject<0x6067, 0>) != kNoWindow;
  const bool in_window = !windowed || window_ms_ > objects_.get(kObject<0x6068, 0>);
  const bool idle = !ip_.active() && !start_requested_;
  if (at_rest && (halt_ || (idle && in_window))) word |= kTargetReached;
  return static_cast<std::uint16_t>(word);
}

void EposDrive::Implementation::publish_status() {
  objects_.set(kObject<0x6041, 0>, statusword());
  objects_.set(kObject<0x20C4, 1>, ip_.status());
  objects_.set(kObject<0x60C4, 2>, PvtBuffer::kCapacity - ip_.fill());
  objects_.set(kObject<0x60C4, 4>, ip_.fill());
}

void EposDrive::Implementation::publish_errors() {
  objects_.set(kObject<0x1001, 0>, errors_.error_register());
  objects_.set(kObject<0x1003, 0>, errors_.history_size());
  for (int i = 1; i <= ErrorStore::kDepth; ++i) {
    objects_.set(object_slot(0x1003, static_cast<std::uint8_t>(i)), errors_.history(i));
  }
}

}  // namespace interpolated_motion::emulation
