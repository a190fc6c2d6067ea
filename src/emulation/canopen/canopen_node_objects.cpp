#include <algorithm>

#include "interpolated_motion_driver/emulation/canopen/canopen_node.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::uint16_t kFirstOfDrive = 0x2000;  // below: communication profile area (CiA 301)
constexpr std::uint16_t kPdoLengthError = 0x8210;

std::uint64_t raw_value(const std::uint8_t* data, std::size_t size) {
  std::uint64_t raw = 0;
  for (std::size_t i = 0; i < size && i < 8; ++i) raw |= static_cast<std::uint64_t>(data[i]) << (8 * i);
  return raw;
}

}  // namespace

AbortCode CanopenNode::sdo_read(std::uint16_t index, std::uint8_t subindex,
                                std::array<std::uint8_t, kSdoCapacity>& data, std::size_t& size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  const ObjectEntry& entry = objects_.entry(slot);
  if (!entry.readable()) return AbortCode::WriteOnly;
  if (entry.type == ObjectType::String) {
    size = settings_.device_name.size();
    std::copy(settings_.device_name.begin(), settings_.device_name.end(), data.begin());
    return AbortCode::None;
  }
  size = static_cast<std::size_t>(size_of(entry.type));
  const std::uint64_t raw = objects_.raw(slot);
  for (std::size_t i = 0; i < size; ++i) data[i] = static_cast<std::uint8_t>(raw >> (8 * i));
  return AbortCode::None;
}

AbortCode CanopenNode::sdo_writable(std::uint16_t index, std::uint8_t subindex, std::size_t& object_size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  object_size = static_cast<std::size_t>(size_of(objects_.entry(slot).type));
  return objects_.entry(slot).writable() ? AbortCode::None : AbortCode::ReadOnly;
}

AbortCode CanopenNode::sdo_write(std::uint16_t index, std::uint8_t subindex, const std::uint8_t* data,
                                 std::size_t size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  return write(slot, size, raw_value(data, size));
}

void CanopenNode::pdo_write(ObjectDictionary::Slot slot, std::uint64_t raw) {
  // A value the drive refuses is lost: a PDO has no answer to carry an abort code.
  static_cast<void>(write(slot, static_cast<std::size_t>(size_of(objects_.entry(slot).type)), raw));
}

void CanopenNode::pdo_too_short() {
  emergency(kPdoLengthError, settings_.communication_error_register, now_);
}

bool CanopenNode::pdo_send(const canopen::Frame& frame) { return transmit(frame); }

AbortCode CanopenNode::write(ObjectDictionary::Slot slot, std::size_t size, std::uint64_t raw) {
  std::int64_t value = 0;
  const ObjectEntry& entry = objects_.entry(slot);
  AbortCode code = objects_.check_write(slot, size, raw, value);
  if (code != AbortCode::None) return code;
  if (PdoEngine::concerns(entry.index)) {
    code = pdo_.check(slot, value, nmt_.operational());
  } else if (entry.index == 0x1003) {
    code = value == 0 ? AbortCode::None : AbortCode::ValueRange;
  } else {
    code = check_value(entry, value);
  }
  if (code != AbortCode::None) return code;
  if (const auto diverted = divert(entry, raw)) return *diverted;
  objects_.set(slot, value);
  if (!communication_written(entry, value)) written(entry, value);
  publish_status();
  return AbortCode::None;
}

// False for an object that means nothing to the node itself.
bool CanopenNode::communication_written(const ObjectEntry& entry, std::int64_t value) {
  if (PdoEngine::concerns(entry.index)) {
    pdo_.configure();
    return true;
  }
  switch (entry.index) {
    case 0x1003:
      errors_.clear_history();
      publish_errors();
      return true;
    case 0x1016:
      nmt_.set_consumer(entry.subindex - 1, static_cast<std::uint32_t>(value));
      return true;
    case 0x1017:
      nmt_.set_producer_time(static_cast<std::uint16_t>(value), milliseconds());
      return true;
    case 0x100C:
    case 0x100D:
      nmt_.set_life_time(this->value(0x100C, 0) * this->value(0x100D, 0));
      return true;
    default:
      return false;
  }
}

void CanopenNode::restore_communication() {
  const ObjectDictionary::Values initial = initial_values();
  for (ObjectDictionary::Slot slot = 0; slot < objects_.size(); ++slot) {
    const ObjectEntry& entry = objects_.entry(slot);
    if (entry.index < kFirstOfDrive && entry.writable()) objects_.set(slot, initial[slot]);
  }
  publish_errors();
}

void CanopenNode::apply_communication() {
  pdo_.configure();
  nmt_.set_life_time(value(0x100C, 0) * value(0x100D, 0));
  for (int i = 0; i < NmtSlave::kConsumers; ++i) {
    nmt_.set_consumer(i, static_cast<std::uint32_t>(value(0x1016, static_cast<std::uint8_t>(i + 1))));
  }
  nmt_.set_producer_time(static_cast<std::uint16_t>(value(0x1017, 0)), milliseconds());
}

void CanopenNode::publish_errors() {
  set(0x1001, 0, errors_.error_register());
  set(0x1003, 0, errors_.history_size());
  for (int i = 1; i <= ErrorStore::kDepth; ++i) set(0x1003, static_cast<std::uint8_t>(i), errors_.history(i));
}

std::int64_t CanopenNode::value(std::uint16_t index, std::uint8_t subindex) const {
  return objects_.get(objects_.find(index, subindex));
}

void CanopenNode::set(std::uint16_t index, std::uint8_t subindex, std::int64_t value) {
  objects_.set(objects_.find(index, subindex), value);
}

}  // namespace interpolated_motion::emulation
