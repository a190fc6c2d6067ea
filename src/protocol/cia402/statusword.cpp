#include "interpolated_motion_driver/protocol/cia402/statusword.h"

#include <array>

#include <fmt/format.h>

namespace interpolated_motion::cia402 {

std::string_view to_text(State state) {
  switch (state) {
    case State::NotReadyToSwitchOn:
      return "not ready to switch on";
    case State::SwitchOnDisabled:
      return "switch on disabled";
    case State::ReadyToSwitchOn:
      return "ready to switch on";
    case State::SwitchedOn:
      return "switched on";
    case State::OperationEnabled:
      return "operation enabled";
    case State::QuickStopActive:
      return "quick stop active";
    case State::FaultReactionActive:
      return "fault reaction active";
    case State::Fault:
      return "fault";
    case State::Unknown:
      break;
  }
  return "unknown state";
}

namespace {

constexpr unsigned kStateBits = 0x6F;

/// By the mask 0x4F, then by 0x6F.
constexpr State state_of(unsigned bits) {
  switch (bits & 0x4F) {
    case 0x00:
      return State::NotReadyToSwitchOn;
    case 0x40:
      return State::SwitchOnDisabled;
    case 0x0F:
      return State::FaultReactionActive;
    case 0x08:
      return State::Fault;
    default:
      break;
  }
  switch (bits & 0x6F) {
    case 0x21:
      return State::ReadyToSwitchOn;
    case 0x23:
      return State::SwitchedOn;
    case 0x27:
      return State::OperationEnabled;
    case 0x07:
      return State::QuickStopActive;
    default:
      return State::Unknown;
  }
}

constexpr std::array<State, kStateBits + 1> make_states() {
  std::array<State, kStateBits + 1> states{};
  for (unsigned bits = 0; bits <= kStateBits; ++bits) states[bits] = state_of(bits);
  return states;
}

constexpr auto kStates = make_states();

}  // namespace

State Statusword::state() const { return kStates[raw & kStateBits]; }

std::string Statusword::text() const {
  std::string text(to_text(state()));
  if (ip_mode_active()) text += ", ip mode active";
  if (target_reached()) text += ", target reached";
  if (internal_limit()) text += ", internal limit active";
  if (warning()) text += ", warning";
  text += remote() ? ", remote" : ", not remote";
  return text + fmt::format(" (0x{:04X})", raw);
}

}  // namespace interpolated_motion::cia402
