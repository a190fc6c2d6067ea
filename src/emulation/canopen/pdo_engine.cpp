#include "interpolated_motion_driver/emulation/canopen/pdo_engine.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::uint16_t kReceiveCommunication = 0x1400;
constexpr std::uint16_t kReceiveMapping = 0x1600;
constexpr std::uint16_t kTransmitCommunication = 0x1800;
constexpr std::uint16_t kTransmitMapping = 0x1A00;
constexpr std::uint16_t kCommunicationToMapping = 0x0200;

constexpr std::uint8_t kSyncTypes = 240;  // 0..240
constexpr std::uint8_t kRequestSampled = 252;
constexpr std::uint8_t kRequest = 253;

constexpr std::int64_t kInvalid = std::int64_t{1} << 31;
constexpr std::int64_t kNoRequest = std::int64_t{1} << 30;
constexpr std::int64_t kIdentifier = 0x1FFFFFFF;
constexpr std::int64_t kExtended = std::int64_t{1} << 29;
constexpr int kPdoBits = 64;

bool is_mapping(std::uint16_t index) { return (index & 0x0200) != 0; }
bool is_receive(std::uint16_t index) { return index < kTransmitCommunication; }

/// `bits`: 1..64
std::uint64_t mask(int bits) { return ~std::uint64_t{0} >> (kPdoBits - bits); }

std::uint64_t load(const canopen::Frame& frame) {
  std::uint64_t data = 0;
  for (std::size_t i = 0; i < 8; ++i) data |= static_cast<std::uint64_t>(frame.data[i]) << (8 * i);
  return data;
}

}  // namespace

bool PdoEngine::concerns(std::uint16_t index) {
  const std::uint16_t base = index & 0xFFFC;
  return base == kReceiveCommunication || base == kReceiveMapping || base == kTransmitCommunication ||
         base == kTransmitMapping;
}

std::int64_t PdoEngine::value(std::uint16_t index, std::uint8_t subindex) const {
  return objects_.get(objects_.find(index, subindex));
}

AbortCode PdoEngine::check(ObjectDictionary::Slot slot, std::int64_t value, bool operational) const {
  const ObjectEntry& entry = objects_.entry(slot);
  if (operational && setup_only_pre_operational_) return AbortCode::WrongNmtState;
  if (is_mapping(entry.index)) {
    return entry.subindex == 0 ? check_mapping_count(entry.index, value)
                               : check_mapping_entry(entry.index, value);
  }
  if (entry.subindex == 1) return check_cob_id(entry.index, value);
  const bool reserved = value > kSyncTypes && value < (is_receive(entry.index) ? 254 : kRequestSampled);
  if (entry.subindex == 2 && reserved) return AbortCode::ValueRange;
  // CiA 301, object 1800h: the inhibit time must not be changed while the PDO exists.
  if (entry.subindex == 3 && valid(entry.index)) return AbortCode::Incompatible;
  return AbortCode::None;
}

AbortCode PdoEngine::check_cob_id(std::uint16_t index, std::int64_t value) const {
  if ((value & kExtended) != 0 || (value & kIdentifier) > 0x7FF) return AbortCode::ValueRange;
  const std::int64_t present = this->value(index, 1);
  const bool stays_valid = (present & kInvalid) == 0 && (value & kInvalid) == 0;
  const bool changed = ((present ^ value) & ~kInvalid) != 0;
  return stays_valid && changed ? AbortCode::Incompatible : AbortCode::None;
}

AbortCode PdoEngine::check_mapping_entry(std::uint16_t index, std::int64_t value) const {
  const auto communication = static_cast<std::uint16_t>(index - kCommunicationToMapping);
  if (valid(communication) || this->value(index, 0) != 0) return AbortCode::Incompatible;
  if (value == 0) return AbortCode::None;
  const auto slot =
      objects_.find(static_cast<std::uint16_t>(value >> 16), static_cast<std::uint8_t>(value >> 8));
  if (slot == ObjectDictionary::kNone) return AbortCode::NoSuchObject;
  const int bits = 8 * size_of(objects_.entry(slot).type);
  return (value & 0xFF) == bits && objects_.mappable(slot, is_receive(index)) ? AbortCode::None
                                                                              : AbortCode::NotMappable;
}

AbortCode PdoEngine::check_mapping_count(std::uint16_t index, std::int64_t value) const {
  const auto communication = static_cast<std::uint16_t>(index - kCommunicationToMapping);
  if (valid(communication)) return AbortCode::Incompatible;
  std::int64_t bits = 0;
  for (std::int64_t i = 1; i <= value; ++i) {
    const std::int64_t entry = this->value(index, static_cast<std::uint8_t>(i));
    if (entry == 0) return AbortCode::NotMappable;
    bits += entry & 0xFF;
  }
  return bits > kPdoBits ? AbortCode::PdoLength : AbortCode::None;
}

PdoEngine::Pdo PdoEngine::compile(std::uint16_t communication, std::uint16_t mapping) const {
  Pdo pdo;
  const std::int64_t cob_id = value(communication, 1);
  pdo.valid = (cob_id & kInvalid) == 0;
  pdo.remote_allowed = (cob_id & kNoRequest) == 0;
  pdo.id = static_cast<std::uint32_t>(cob_id & kIdentifier);
  pdo.type = static_cast<std::uint8_t>(value(communication, 2));
  if (!is_receive(communication)) pdo.inhibit = static_cast<int>(value(communication, 3));
  pdo.count = static_cast<int>(value(mapping, 0));
  int bits = 0;
  for (int i = 0; i < pdo.count; ++i) {
    const std::int64_t entry = value(mapping, static_cast<std::uint8_t>(i + 1));
    Mapped& mapped = pdo.map[static_cast<std::size_t>(i)];
    mapped.slot =
        objects_.find(static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8));
    mapped.bits = static_cast<int>(entry & 0xFF);
    bits += mapped.bits;
  }
  pdo.length = bits / 8;
  return pdo;
}

void PdoEngine::configure() {
  for (std::uint16_t i = 0; i < kCount; ++i) {
    receive_[i] = compile(static_cast<std::uint16_t>(kReceiveCommunication + i),
                          static_cast<std::uint16_t>(kReceiveMapping + i));
    transmit_[i] = compile(static_cast<std::uint16_t>(kTransmitCommunication + i),
                           static_cast<std::uint16_t>(kTransmitMapping + i));
  }
}

void PdoEngine::start() { configure(); }

bool PdoEngine::on_frame(const canopen::Frame& frame) {
  for (Pdo& pdo : receive_) {
    if (!pdo.valid || pdo.id != frame.id) continue;
    if (frame.length < pdo.length) {
      owner_.pdo_too_short();
      return true;
    }
    pdo.data = load(frame);
    pdo.pending = pdo.type <= kSyncTypes;
    if (!pdo.pending) apply(pdo);
    return true;
  }
  return false;
}

void PdoEngine::apply(Pdo& pdo) {
  std::uint64_t data = pdo.data;
  pdo.pending = false;
  for (int i = 0; i < pdo.count; ++i) {
    const Mapped mapped = pdo.map[static_cast<std::size_t>(i)];
    owner_.pdo_write(mapped.slot, data & mask(mapped.bits));
    data = mapped.bits >= kPdoBits ? 0 : data >> mapped.bits;
  }
}

void PdoEngine::on_sync() {
  for (Pdo& pdo : receive_) {
    if (pdo.valid && pdo.pending) apply(pdo);
  }
  for (Pdo& pdo : transmit_) {
    if (pdo.valid) sync_transmit(pdo);
  }
}

void PdoEngine::sync_transmit(Pdo& pdo) {
  if (pdo.type == kRequestSampled) pdo.data = pack(pdo);
  if (pdo.type > kSyncTypes) return;
  const std::uint64_t data = pack(pdo);
  ++pdo.syncs;
  const bool due = pdo.type == 0 ? (!pdo.ever_sent || data != pdo.last) : pdo.syncs >= pdo.type;
  if (!due) return;
  pdo.syncs = 0;
  send(pdo, data);
}

void PdoEngine::on_remote_request(const canopen::Frame& frame) {
  for (Pdo& pdo : transmit_) {
    if (!pdo.valid || pdo.id != frame.id || !pdo.remote_allowed) continue;
    send(pdo, pdo.type == kRequestSampled ? pdo.data : pack(pdo));
  }
}

void PdoEngine::tick(std::int64_t now_100us) {
  for (Pdo& pdo : transmit_) {
    if (!pdo.valid || pdo.type <= kRequest) continue;
    const std::uint64_t data = pack(pdo);
    if (pdo.ever_sent && data == pdo.last) continue;
    if (pdo.ever_sent && now_100us - pdo.sent_at < pdo.inhibit) continue;
    if (send(pdo, data)) pdo.sent_at = now_100us;
  }
}

std::uint64_t PdoEngine::pack(const Pdo& pdo) const {
  std::uint64_t data = 0;
  int shift = 0;
  for (int i = 0; i < pdo.count; ++i) {
    const Mapped mapped = pdo.map[static_cast<std::size_t>(i)];
    data |= (static_cast<std::uint64_t>(objects_.get(mapped.slot)) & mask(mapped.bits)) << shift;
    shift += mapped.bits;
  }
  return data;
}

bool PdoEngine::send(Pdo& pdo, std::uint64_t data) {
  canopen::Frame frame;
  frame.id = pdo.id;
  frame.length = static_cast<std::uint8_t>(pdo.length);
  for (std::size_t i = 0; i < frame.length; ++i) frame.data[i] = static_cast<std::uint8_t>(data >> (8 * i));
  if (!owner_.pdo_send(frame)) return false;
  pdo.last = data;
  pdo.ever_sent = true;
  return true;
}

}  // namespace interpolated_motion::emulation
