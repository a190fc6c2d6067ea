#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/canopen/object_dictionary.h"

namespace interpolated_motion::emulation {

/// States of the device control state machine of CiA 402.
enum class DeviceState {
  SwitchOnDisabled,
  ReadyToSwitchOn,
  SwitchedOn,
  OperationEnabled,
  QuickStopActive,
  FaultReaction,
  Fault,
};

/// Ramp on which the axis has to come to rest.
enum class StopRamp { None, Profile, QuickStop };

/// Option codes the state machine reacts by.
struct OptionCodes {
  std::int16_t abort_connection = 1;   ///< 0x6007: 1 fault, 2 disable voltage, 3 quick stop, else nothing
  std::int16_t shutdown = 0;           ///< 0x605B: 0 at once, 1 slow down
  std::int16_t disable_operation = 1;  ///< 0x605C: 0 at once, 1 slow down
  std::int16_t fault_reaction = 2;     ///< 0x605E: 0 at once, 1 profile ramp, 2 quick-stop ramp
};

/// As they are in the objects of a drive.
OptionCodes option_codes(const ObjectDictionary& objects);

/// Device control of CiA 402 as EPOS2 has it: Switch on and Enable operation may come in one controlword,
/// Quick stop active can be left to Operation enable, and the statusword's bit 4 tells of the power stage.
class DeviceControl {
 public:
  /// As of the latest command, fault or end of a ramp; Switch on disabled at first. The power stage is on in
  /// Operation enabled, Quick stop active and Fault reaction active.
  DeviceState state() const { return state_; }
  bool power_stage() const;
  bool operation_enabled() const { return state_ == DeviceState::OperationEnabled; }
  /// The axis does what the mode of operation says: enabled, and on no ramp.
  bool in_control() const { return operation_enabled() && ramp_ == StopRamp::None; }

  /// Ramp under way; when it has come to its end, at_rest() is to be called.
  StopRamp ramp() const { return ramp_; }
  /// The ramp under way has ended: the state it was to lead to is entered. Nothing happens without a ramp.
  void at_rest();

  /// A new controlword. True when it was a fault reset that took effect.
  bool command(std::uint16_t controlword, const OptionCodes& options);

  /// An error of the drive: brakes as 0x605E says while the power stage is on, then Fault. Nothing happens
  /// where a fault is there already.
  void fault(const OptionCodes& options);
  /// The host has been lost.
  void connection_lost(const OptionCodes& options);
  /// Of an enabled axis: brakes on the quick-stop ramp and stays in Quick stop active. Of any other: as
  /// disable_voltage().
  void quick_stop();
  /// To Switch on disabled at once, whatever the axis is doing; a fault is not looked at.
  void disable_voltage();
  void reset() { *this = DeviceControl(); }

  /// Statusword bits 0..6 and 8 (EPOS2: "offset current measured", set once booted).
  std::uint16_t status_bits() const;

 private:
  void leave_operation(DeviceState next, StopRamp ramp);
  void shutdown(const OptionCodes& options);
  void switch_on(const OptionCodes& options);
  void enable();

  DeviceState state_ = DeviceState::SwitchOnDisabled;
  StopRamp ramp_ = StopRamp::None;
  DeviceState after_ramp_ = DeviceState::SwitchOnDisabled;
  bool reset_bit_ = false;
};

}  // namespace interpolated_motion::emulation
