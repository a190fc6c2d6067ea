#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/axis.h"
#include "interpolated_motion_driver/emulation/silverdust/error_limits.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/registers.h"

namespace interpolated_motion::emulation {

/// The data registers as hosts and standalone programs see them (Command Reference, RRG, WRI, WRP): some show
/// what the drive does, others must not be written while it uses them.
class DataRegisters {
 public:
  /// Shows what it is given, which must outlive it.
  DataRegisters(const SilverDustParameters& parameters, RegisterFile& registers, MotionControl& motion,
                const LaggingAxis& axis, const ErrorLimits& limits)
      : replies_(parameters.replies), registers_(registers), motion_(motion), axis_(axis), limits_(limits) {}

  /// Register `number`, which must exist (RegisterFile).
  std::int32_t read(std::int64_t number) const;

  /// Writes register `number`, which must be writable (RegisterFile). An IMS operation that uses it
  /// ("Interpolated Motion": registers 18 and 20..23) goes on with the new value from its next tick on; or
  /// false, and nothing is written, as `segment_writes` says.
  bool write(std::int64_t number, std::int32_t value);

 private:
  std::int32_t target_position() const;
  std::int32_t position_error() const;
  std::int32_t velocity() const;

  const SilverDustReplies replies_;
  RegisterFile& registers_;
  MotionControl& motion_;
  const LaggingAxis& axis_;
  const ErrorLimits& limits_;
};

}  // namespace interpolated_motion::emulation
