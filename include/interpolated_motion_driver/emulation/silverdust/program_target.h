#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/data_registers.h"
#include "interpolated_motion_driver/emulation/silverdust/electronics.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_status.h"

namespace interpolated_motion::emulation {

/// What the lines of a standalone program work on. Nobody hears an answer to them: one that cannot be obeyed
/// sets bit 12 of the polling status word (command error).
class ProgramTarget {
 public:
  /// Works on what it is given, which must outlive it.
  ProgramTarget(DataRegisters& registers, MotionControl& motion, const Electronics& electronics,
                PollingStatus& polling)
      : registers_(registers), motion_(motion), electronics_(electronics), polling_(polling) {}

  /// WRP.
  void write(std::int64_t reg, std::int32_t value);

  /// 0 when there is no such register.
  std::int32_t read(std::int64_t reg) const;

  /// IMS, which the drive cannot obey during a motion or while the driver is disabled.
  void start_interpolation();

 private:
  DataRegisters& registers_;
  MotionControl& motion_;
  const Electronics& electronics_;
  PollingStatus& polling_;
};

}  // namespace interpolated_motion::emulation
