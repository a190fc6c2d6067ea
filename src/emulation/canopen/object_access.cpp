#include "interpolated_motion_driver/emulation/canopen/object_access.h"

#include <algorithm>
#include <utility>

namespace interpolated_motion::emulation {
namespace {

std::uint64_t raw_value(const std::uint8_t* data, std::size_t size) {
  std::uint64_t raw = 0;
  for (std::size_t i = 0; i < size && i < 8; ++i) raw |= static_cast<std::uint64_t>(data[i]) << (8 * i);
  return raw;
}

}  // namespace

ObjectAccess::ObjectAccess(ObjectDictionary& objects, std::string device_name,
                           CommunicationObjects& communication, ObjectOwner& owner)
    : objects_(objects), device_name_(std::move(device_name)), communication_(communication), owner_(owner) {}

AbortCode ObjectAccess::sdo_read(std::uint16_t index, std::uint8_t subindex,
                                 std::array<std::uint8_t, kSdoCapacity>& data, std::size_t& size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  const ObjectEntry& entry = objects_.entry(slot);
  if (!entry.readable()) return AbortCode::WriteOnly;
  if (entry.type == ObjectType::String) {
    size = device_name_.size();
    std::copy(device_name_.begin(), device_name_.end(), data.begin());
    return AbortCode::None;
  }
  size = static_cast<std::size_t>(size_of(entry.type));
  const std::uint64_t raw = objects_.raw(slot);
  for (std::size_t i = 0; i < size; ++i) data[i] = static_cast<std::uint8_t>(raw >> (8 * i));
  return AbortCode::None;
}

AbortCode ObjectAccess::sdo_writable(std::uint16_t index, std::uint8_t subindex, std::size_t& object_size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  object_size = static_cast<std::size_t>(size_of(objects_.entry(slot).type));
  return objects_.entry(slot).writable() ? AbortCode::None : AbortCode::ReadOnly;
}

AbortCode ObjectAccess::sdo_write(std::uint16_t index, std::uint8_t subindex, const std::uint8_t* data,
                                  std::size_t size) {
  const auto slot = objects_.find(index, subindex);
  if (slot == ObjectDictionary::kNone) return objects_.why_missing(index);
  return write(slot, size, raw_value(data, size));
}

void ObjectAccess::pdo_write(ObjectDictionary::Slot slot, std::uint64_t raw) {
  static_cast<void>(write(slot, static_cast<std::size_t>(size_of(objects_.entry(slot).type)), raw));
}

AbortCode ObjectAccess::write(ObjectDictionary::Slot slot, std::size_t size, std::uint64_t raw) {
  std::int64_t value = 0;
  const ObjectEntry& entry = objects_.entry(slot);
  AbortCode code = objects_.check_write(slot, size, raw, value);
  if (code != AbortCode::None) return code;
  code = CommunicationObjects::rules(entry.index) ? communication_.check(slot, value)
                                                  : owner_.check_value(entry, value);
  if (code != AbortCode::None) return code;
  if (const auto diverted = owner_.divert(entry, raw)) return *diverted;
  objects_.set(slot, value);
  if (!communication_.written(entry, value)) owner_.written(entry, value);
  owner_.publish_status();
  return AbortCode::None;
}

}  // namespace interpolated_motion::emulation
