#include "interpolated_motion_driver/emulation/canopen/emergency_producer.h"

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::int64_t kInvalidCobId = std::int64_t{1} << 31;
constexpr std::int64_t kIdentifier = 0x7FF;

}  // namespace

void EmergencyProducer::raise(std::uint16_t code, std::uint8_t error_register, HostTime now) {
  ++raised_;
  send(errors_.raise(code, error_register), now);
  publish();
}

void EmergencyProducer::reset(HostTime now) {
  send(errors_.reset(), now);
  publish();
}

void EmergencyProducer::clear_history() {
  errors_.clear_history();
  publish();
}

void EmergencyProducer::publish() {
  objects_.set(0x1001, 0, errors_.error_register());
  objects_.set(0x1003, 0, errors_.history_size());
  for (int i = 1; i <= ErrorStore::kDepth; ++i) {
    objects_.set(0x1003, static_cast<std::uint8_t>(i), errors_.history(i));
  }
}

void EmergencyProducer::send(const EmergencyBytes& bytes, HostTime now) {
  const std::int64_t cob_id = objects_.get(0x1014, 0);
  const bool silenced = nmt_.state() == NmtState::Stopped || !nmt_.communicating();
  if (silenced || (cob_id & kInvalidCobId) != 0) return;
  canopen::Frame frame;
  frame.id = static_cast<std::uint32_t>(cob_id & kIdentifier);
  frame.length = 8;
  frame.data = bytes;
  port_.send(frame, now);
}

}  // namespace interpolated_motion::emulation
