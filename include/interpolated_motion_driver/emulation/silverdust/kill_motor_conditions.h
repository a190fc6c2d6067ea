#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/internal_status.h"

namespace interpolated_motion::emulation {

/// The kill motor conditions (Command Reference, KMC): the motor is shut down when one of the enabled bits of
/// the internal status word has the state chosen for it. As delivered: over-temperature.
class KillMotorConditions {
 public:
  /// KMC: bits of status_bit, and the state each of them has to have.
  void set(std::uint16_t enable, std::uint16_t state) {
    enable_ = enable;
    state_ = state;
  }

  /// Whether the motor is to be shut down at internal status word `status`: a condition is met that was not
  /// when this was asked before, or one is met and the motor's driver is enabled.
  bool trip(std::uint16_t status, bool driver_enabled) {
    const auto equal = static_cast<std::uint16_t>(~(status ^ state_));
    const bool met = (equal & enable_) != 0;
    const bool known = met_ && !driver_enabled;
    met_ = met;
    return met && !known;
  }

 private:
  std::uint16_t enable_ = status_bit::kTemperatureOk;
  std::uint16_t state_ = 0;
  bool met_ = false;
};

}  // namespace interpolated_motion::emulation
