#include "interpolated_motion_driver/emulation/canopen/nmt_slave.h"

namespace interpolated_motion::emulation {

void NmtSlave::restart() { *this = NmtSlave(); }

NmtAction NmtSlave::command(std::uint8_t specifier) {
  const NmtState before = state_;
  switch (specifier) {
    case 1:
      state_ = NmtState::Operational;
      break;
    case 2:
      state_ = NmtState::Stopped;
      break;
    case 128:
      state_ = NmtState::PreOperational;
      break;
    case 129:
      return NmtAction::ResetNode;
    case 130:
      return NmtAction::ResetCommunication;
    default:
      return NmtAction::None;
  }
  return state_ == before ? NmtAction::None : NmtAction::Entered;
}

void NmtSlave::set_producer_time(std::uint16_t ms, std::int64_t now_ms) {
  producer_ms_ = ms;
  next_heartbeat_ms_ = now_ms;
}

bool NmtSlave::heartbeat_due(std::int64_t now_ms) {
  if (producer_ms_ == 0 || now_ms < next_heartbeat_ms_) return false;
  next_heartbeat_ms_ = now_ms + producer_ms_;
  return true;
}

void NmtSlave::set_consumer(int consumer, std::uint32_t value) {
  Consumer& entry = consumers_[static_cast<std::size_t>(consumer)];
  entry = Consumer{};
  entry.node = static_cast<std::uint8_t>((value >> 16) & 0x7F);
  entry.time_ms = value & 0xFFFF;
}

bool NmtSlave::on_heartbeat(std::uint8_t node, std::int64_t now_ms) {
  bool back = false;
  for (Consumer& entry : consumers_) {
    if (entry.node != node || entry.time_ms == 0) continue;
    back = back || entry.lost;
    entry.watching = true;
    entry.lost = false;
    entry.last_ms = now_ms;
  }
  return back;
}

std::uint8_t NmtSlave::guard(std::int64_t now_ms) {
  guarded_ = life_ms_ > 0;
  last_guard_ms_ = now_ms;
  const auto answer = static_cast<std::uint8_t>((toggle_ ? 0x80 : 0) | static_cast<std::uint8_t>(state_));
  toggle_ = !toggle_;
  return answer;
}

bool NmtSlave::connection_lost(std::int64_t now_ms) {
  bool lost = false;
  for (Consumer& entry : consumers_) {
    if (!entry.watching || now_ms - entry.last_ms <= entry.time_ms) continue;
    entry.watching = false;
    entry.lost = true;
    lost = true;
  }
  if (guarded_ && now_ms - last_guard_ms_ > life_ms_) {
    guarded_ = false;
    lost = true;
  }
  return lost;
}

}  // namespace interpolated_motion::emulation
