#include "interpolated_motion_driver/emulation/canopen/communication_objects.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::uint16_t kFirstOfDrive = 0x2000;
constexpr std::uint16_t kErrorHistory = 0x1003;
constexpr std::uint16_t kGuardTime = 0x100C;
constexpr std::uint16_t kLifeTimeFactor = 0x100D;
constexpr std::uint16_t kHeartbeatConsumers = 0x1016;
constexpr std::uint16_t kHeartbeatTime = 0x1017;

}  // namespace

bool CommunicationObjects::rules(std::uint16_t index) {
  return PdoEngine::concerns(index) || index == kErrorHistory;
}

AbortCode CommunicationObjects::check(ObjectDictionary::Slot slot, std::int64_t value) const {
  if (objects_.entry(slot).index != kErrorHistory) return pdo_.check(slot, value, nmt_.operational());
  return value == 0 ? AbortCode::None : AbortCode::ValueRange;
}

bool CommunicationObjects::written(const ObjectEntry& entry, std::int64_t value) {
  if (PdoEngine::concerns(entry.index)) {
    pdo_.configure();
    return true;
  }
  switch (entry.index) {
    case kErrorHistory:
      emergencies_.clear_history();
      return true;
    case kHeartbeatConsumers:
      nmt_.set_consumer(entry.subindex - 1, static_cast<std::uint32_t>(value));
      return true;
    case kHeartbeatTime:
      nmt_.set_producer_time(static_cast<std::uint16_t>(value), clock_.milliseconds());
      return true;
    case kGuardTime:
    case kLifeTimeFactor:
      nmt_.set_life_time(objects_.get(kGuardTime, 0) * objects_.get(kLifeTimeFactor, 0));
      return true;
    default:
      return false;
  }
}

void CommunicationObjects::apply() {
  pdo_.configure();
  nmt_.set_life_time(objects_.get(kGuardTime, 0) * objects_.get(kLifeTimeFactor, 0));
  for (int i = 0; i < NmtSlave::kConsumers; ++i) {
    const std::int64_t consumer = objects_.get(kHeartbeatConsumers, static_cast<std::uint8_t>(i + 1));
    nmt_.set_consumer(i, static_cast<std::uint32_t>(consumer));
  }
  nmt_.set_producer_time(static_cast<std::uint16_t>(objects_.get(kHeartbeatTime, 0)), clock_.milliseconds());
}

void CommunicationObjects::restore(const ObjectDictionary::Values& initial) {
  for (ObjectDictionary::Slot slot = 0; slot < objects_.size(); ++slot) {
    const ObjectEntry& entry = objects_.entry(slot);
    if (entry.index < kFirstOfDrive && entry.writable()) objects_.set(slot, initial[slot]);
  }
  emergencies_.publish();
}

}  // namespace interpolated_motion::emulation
