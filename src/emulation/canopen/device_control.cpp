#include "interpolated_motion_driver/emulation/canopen/device_control.h"

namespace interpolated_motion::emulation {
namespace {

// Controlword bits of CiA 402.
constexpr unsigned kSwitchOn = 1U << 0;
constexpr unsigned kEnableVoltage = 1U << 1;
constexpr unsigned kNoQuickStop = 1U << 2;
constexpr unsigned kEnableOperation = 1U << 3;
constexpr unsigned kFaultReset = 1U << 7;

}  // namespace

OptionCodes option_codes(const ObjectDictionary& objects) {
  const auto value = [&objects](std::uint16_t index) { return objects.get(objects.find(index, 0)); };
  OptionCodes options;
  options.abort_connection = static_cast<std::int16_t>(value(0x6007));
  options.shutdown = static_cast<std::int16_t>(value(0x605B));
  options.disable_operation = static_cast<std::int16_t>(value(0x605C));
  options.fault_reaction = static_cast<std::int16_t>(value(0x605E));
  return options;
}

bool DeviceControl::power_stage() const {
  return state_ == DeviceState::OperationEnabled || state_ == DeviceState::QuickStopActive ||
         state_ == DeviceState::FaultReaction;
}

std::uint16_t DeviceControl::status_bits() const {
  switch (state_) {
    case DeviceState::SwitchOnDisabled:
      return 0x0140;
    case DeviceState::ReadyToSwitchOn:
      return 0x0121;
    case DeviceState::SwitchedOn:
      return 0x0123;
    case DeviceState::OperationEnabled:
      return 0x0137;
    case DeviceState::QuickStopActive:
      return 0x0117;
    case DeviceState::FaultReaction:
      return 0x011F;
    case DeviceState::Fault:
      return 0x0108;
  }
  return 0;
}

bool DeviceControl::command(std::uint16_t controlword, const OptionCodes& options) {
  const bool rising = (controlword & kFaultReset) != 0 && !reset_bit_;
  reset_bit_ = (controlword & kFaultReset) != 0;
  if (state_ == DeviceState::FaultReaction) return false;
  if (state_ == DeviceState::Fault) {
    if (rising) state_ = DeviceState::SwitchOnDisabled;
    return rising;
  }
  if ((controlword & kEnableVoltage) == 0) {
    disable_voltage();
  } else if ((controlword & kNoQuickStop) == 0) {
    quick_stop();
  } else if ((controlword & kSwitchOn) == 0) {
    shutdown(options);
  } else if ((controlword & kEnableOperation) == 0) {
    switch_on(options);
  } else {
    enable();
  }
  return false;
}

void DeviceControl::disable_voltage() {
  state_ = DeviceState::SwitchOnDisabled;
  ramp_ = StopRamp::None;
}

void DeviceControl::quick_stop() {
  if (state_ == DeviceState::OperationEnabled) {
    state_ = DeviceState::QuickStopActive;
    leave_operation(DeviceState::QuickStopActive, StopRamp::QuickStop);
  } else if (state_ != DeviceState::QuickStopActive) {
    disable_voltage();
  }
}

void DeviceControl::shutdown(const OptionCodes& options) {
  if (state_ == DeviceState::SwitchOnDisabled || state_ == DeviceState::SwitchedOn) {
    state_ = DeviceState::ReadyToSwitchOn;
  } else if (state_ == DeviceState::OperationEnabled) {
    leave_operation(DeviceState::ReadyToSwitchOn, options.shutdown == 0 ? StopRamp::None : StopRamp::Profile);
  }
}

void DeviceControl::switch_on(const OptionCodes& options) {
  if (state_ == DeviceState::ReadyToSwitchOn) {
    state_ = DeviceState::SwitchedOn;
  } else if (state_ == DeviceState::OperationEnabled) {
    leave_operation(DeviceState::SwitchedOn,
                    options.disable_operation == 0 ? StopRamp::None : StopRamp::Profile);
  }
}

void DeviceControl::enable() {
  if (state_ == DeviceState::SwitchOnDisabled) return;
  state_ = DeviceState::OperationEnabled;
  ramp_ = StopRamp::None;
}

void DeviceControl::leave_operation(DeviceState next, StopRamp ramp) {
  after_ramp_ = next;
  ramp_ = ramp;
  if (ramp == StopRamp::None) state_ = next;
}

void DeviceControl::at_rest() {
  if (ramp_ == StopRamp::None) return;
  ramp_ = StopRamp::None;
  state_ = after_ramp_;
}

void DeviceControl::connection_lost(const OptionCodes& options) {
  switch (options.abort_connection) {
    case 1:
      return fault(options);
    case 2:
      return disable_voltage();
    case 3:
      if (operation_enabled()) quick_stop();
      return;
    default:
      return;
  }
}

void DeviceControl::fault(const OptionCodes& options) {
  if (state_ == DeviceState::Fault || state_ == DeviceState::FaultReaction) return;
  const bool slow_down = power_stage() && options.fault_reaction != 0;
  state_ = DeviceState::FaultReaction;
  const StopRamp ramp = options.fault_reaction == 1 ? StopRamp::Profile : StopRamp::QuickStop;
  leave_operation(DeviceState::Fault, slow_down ? ramp : StopRamp::None);
}

}  // namespace interpolated_motion::emulation
