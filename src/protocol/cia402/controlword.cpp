#include "interpolated_motion_driver/protocol/cia402/controlword.h"

namespace interpolated_motion::cia402 {
namespace {

constexpr ControlStep send(std::uint16_t word) { return {ControlStep::Kind::Send, word}; }
constexpr ControlStep kImpossible{ControlStep::Kind::Impossible, 0};

/// The three states below Operation enabled can be commanded from each other and from above by one word each.
ControlStep to_lower_state(State target) {
  switch (target) {
    case State::SwitchOnDisabled:
      return send(controlword::kDisableVoltage);
    case State::ReadyToSwitchOn:
      return send(controlword::kShutdown);
    case State::SwitchedOn:
      return send(controlword::kSwitchOn);
    default:
      return kImpossible;
  }
}

ControlStep from_switch_on_disabled(State target) {
  const bool upwards =
      target == State::ReadyToSwitchOn || target == State::SwitchedOn || target == State::OperationEnabled;
  return upwards ? send(controlword::kShutdown) : kImpossible;
}

ControlStep from_ready_or_switched_on(State target) {
  return target == State::OperationEnabled ? send(controlword::kEnableOperation) : to_lower_state(target);
}

ControlStep from_operation_enabled(State target) {
  return target == State::QuickStopActive ? send(controlword::kQuickStop) : to_lower_state(target);
}

/// Out of a quick stop the drive goes on (transition 16), or is disabled first.
ControlStep from_quick_stop(State target) {
  if (target == State::OperationEnabled) return send(controlword::kEnableOperation);
  return to_lower_state(target).kind == ControlStep::Kind::Send ? send(controlword::kDisableVoltage)
                                                                : kImpossible;
}

}  // namespace

ControlStep next_controlword(State current, State target) {
  if (current == State::Fault) return {ControlStep::Kind::NeedsFaultReset, 0};
  if (current == target) return {ControlStep::Kind::Arrived, 0};
  switch (current) {
    case State::NotReadyToSwitchOn:
    case State::FaultReactionActive:
      return {ControlStep::Kind::Wait, 0};
    case State::SwitchOnDisabled:
      return from_switch_on_disabled(target);
    case State::ReadyToSwitchOn:
    case State::SwitchedOn:
      return from_ready_or_switched_on(target);
    case State::OperationEnabled:
      return from_operation_enabled(target);
    case State::QuickStopActive:
      return from_quick_stop(target);
    case State::Fault:
    case State::Unknown:
      break;
  }
  return kImpossible;
}

}  // namespace interpolated_motion::cia402
