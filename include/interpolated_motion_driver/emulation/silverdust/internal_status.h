#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/parameters.h"

namespace interpolated_motion::emulation {

/// Bits of the internal status word (ISW, answered to RIS; Command Reference, RIS and CIS).
namespace status_bit {
inline constexpr std::uint16_t kIndexFound = 1U << 0;
inline constexpr std::uint16_t kCalculationZero = 1U << 1;
inline constexpr int kInputs = 4;                         ///< inputs 1..3 in bits 4..6
inline constexpr std::uint16_t kTemperatureOk = 1U << 7;  ///< 0: over-temperature
inline constexpr std::uint16_t kMovingError = 1U << 8;
inline constexpr std::uint16_t kHoldingError = 1U << 9;
inline constexpr std::uint16_t kHalted = 1U << 10;  ///< HLT was received
inline constexpr std::uint16_t kOverVoltage = 1U << 13;
inline constexpr std::uint16_t kLowVoltage = 1U << 14;
/// What CIS clears. Bits 11 and 12 (input found, delay expired) are among it, though this drive sets neither.
inline constexpr std::uint16_t kLatched =
    kMovingError | kHoldingError | kHalted | 1U << 11 | 1U << 12 | kOverVoltage | kLowVoltage;
}  // namespace status_bit

/// Bits of the I/O word (answered to RIO).
namespace io_bit {
inline constexpr std::uint16_t kTrajectoryActive = 1U << 3;  ///< a motion is running
inline constexpr int kInputs = 4;                            ///< I/O 1..3 in bits 4..6
inline constexpr std::uint16_t kTemperatureOk = 1U << 7;
inline constexpr std::uint16_t kMovingError = 1U << 8;
inline constexpr std::uint16_t kHoldingError = 1U << 9;
}  // namespace io_bit

/// What the drive knows of itself: the internal status word and, made of the same facts, the I/O word.
/// Neither says whether the driver is enabled.
class InternalStatus {
 public:
  /// Inputs as `parameters` say, for good; all else as after power-up.
  explicit InternalStatus(const SilverDustParameters& parameters)
      : status_inputs_(parameters.status_inputs), io_inputs_(parameters.io_inputs) {}

  /// As after power-up: nothing has happened, the temperature is right.
  void restart();

  /// Sets `bits` of status_bit until clear(). False when all of them were set before.
  bool latch(std::uint16_t bits);

  /// The drive is too hot, until clear().
  void set_over_temperature() { temperature_ok_ = false; }

  /// CIS: clears what is latched, and the over-temperature.
  void clear();

  /// As RIS answers it.
  std::uint16_t word() const;

  /// As RIO answers it. `trajectory_active`: a motion is running.
  std::uint16_t io_word(bool trajectory_active) const;

 private:
  static constexpr std::uint16_t kPowerUp = status_bit::kIndexFound | status_bit::kCalculationZero;

  const std::uint16_t status_inputs_;
  const std::uint16_t io_inputs_;
  std::uint16_t latched_ = kPowerUp;
  bool temperature_ok_ = true;
};

}  // namespace interpolated_motion::emulation
