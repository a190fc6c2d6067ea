#include "interpolated_motion_driver/emulation/canopen/error_store.h"

#include <algorithm>

namespace interpolated_motion::emulation {
namespace {

// Bit 0 of 0x1001, "generic error", is set with every error (CiA 301, object 1001h).
constexpr std::uint8_t kGenericError = 0x01;

}  // namespace

EmergencyBytes ErrorStore::raise(std::uint16_t code, std::uint8_t error_register) {
  register_ = static_cast<std::uint8_t>(register_ | error_register | kGenericError);
  std::copy_backward(history_.begin(), history_.end() - 1, history_.end());
  history_[0] = code;
  size_ = std::min(size_ + 1, kDepth);
  return {static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(code >> 8), register_};
}

EmergencyBytes ErrorStore::reset() {
  register_ = 0;
  return {};
}

void ErrorStore::clear_history() {
  history_.fill(0);
  size_ = 0;
}

}  // namespace interpolated_motion::emulation
