#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/internal_status.h"
#include "interpolated_motion_driver/emulation/silverdust/kill_motor_conditions.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_status.h"
#include "interpolated_motion_driver/emulation/silverdust/program.h"

namespace interpolated_motion::emulation {

/// The motor's driver, the faults of supply, temperature and position, and the kill motor recovery: motion
/// and program end, and the driver goes off unless KED keeps it on (Command Reference, EMD, DMD, HLT, KMC,
/// KED, KDD, CIS).
class Electronics {
 public:
  /// Reports to `polling` and ends `motion` and `program`, which must all outlive it.
  Electronics(const SilverDustParameters& parameters, PollingStatus& polling, MotionControl& motion,
              StoredProgram& program);

  /// As after power-up: no fault, conditions as delivered, the driver as the parameters say.
  void restart();

  /// The motor's driver is on: the axis follows the target.
  bool enabled() const { return enabled_; }

  /// EMD (true) and DMD (false).
  void enable(bool on);

  /// HLT: kill motor recovery, and bit 10 of the internal status word.
  void halt();

  /// KMC, see KillMotorConditions. Shuts down at once when one of them is met.
  void set_kill_conditions(std::uint16_t enable, std::uint16_t state);

  /// KED (true) and KDD (false): whether the driver stays on in a kill motor recovery.
  void keep_driver(bool keep) { keeps_driver_ = keep; }

  /// CIS: the faults are forgotten; a condition that asks for the absence of a fault may be met then.
  void clear_status();

  /// Faults, or the reports of them. They stay until CIS, and shut down when a condition is met.
  void over_temperature();
  void over_voltage() { latch(status_bit::kOverVoltage, polling_bit::kVoltage); }
  void low_voltage() { latch(status_bit::kLowVoltage, polling_bit::kVoltage); }
  void moving_error() { latch(status_bit::kMovingError, polling_bit::kMovingError); }
  void holding_error() { latch(status_bit::kHoldingError, polling_bit::kHoldingError); }

  /// The internal status word and the I/O word.
  const InternalStatus& status() const { return status_; }

 private:
  void latch(std::uint16_t status_bits, std::uint16_t polling_bits);
  void check_kill_conditions();
  void kill();

  const bool enabled_at_power_up_;
  PollingStatus& polling_;
  MotionControl& motion_;
  StoredProgram& program_;
  InternalStatus status_;
  KillMotorConditions conditions_;
  bool enabled_ = false;
  bool keeps_driver_ = false;
};

}  // namespace interpolated_motion::emulation
