#pragma once

#include <cstdint>

namespace interpolated_motion::emulation {

/// Bits of the polling status word (POL, POR).
namespace polling_bit {
inline constexpr std::uint16_t kAborted = 1U << 0;
inline constexpr std::uint16_t kShutDown = 1U << 3;  ///< by a kill motor condition
inline constexpr std::uint16_t kTooLong = 1U << 5;
inline constexpr std::uint16_t kStatusCheck = 1U << 6;  ///< condition of CKS met
inline constexpr std::uint16_t kMovingError = 1U << 8;
inline constexpr std::uint16_t kHoldingError = 1U << 9;
inline constexpr std::uint16_t kVoltage = 1U << 10;
inline constexpr std::uint16_t kCommandError = 1U << 12;
inline constexpr std::uint16_t kDone = 1U << 13;
inline constexpr std::uint16_t kImmediateDone = 1U << 15;
}  // namespace polling_bit

/// Bits of the internal status word (RIS).
namespace status_bit {
inline constexpr std::uint16_t kIndexFound = 1U << 0;
inline constexpr std::uint16_t kCalculationZero = 1U << 1;
inline constexpr int kInputs = 4;  ///< inputs 1..3 in bits 4..6
inline constexpr std::uint16_t kTemperatureOk = 1U << 7;
inline constexpr std::uint16_t kMovingError = 1U << 8;
inline constexpr std::uint16_t kHoldingError = 1U << 9;
inline constexpr std::uint16_t kHalted = 1U << 10;
inline constexpr std::uint16_t kOverVoltage = 1U << 13;
inline constexpr std::uint16_t kLowVoltage = 1U << 14;
/// What CIS clears.
inline constexpr std::uint16_t kLatched =
    kMovingError | kHoldingError | kHalted | 1U << 11 | 1U << 12 | kOverVoltage | kLowVoltage;
}  // namespace status_bit

/// Bits of the I/O word (RIO).
namespace io_bit {
inline constexpr std::uint16_t kTrajectoryActive = 1U << 3;
inline constexpr int kInputs = 4;  ///< I/O 1..3 in bits 4..6
inline constexpr std::uint16_t kTemperatureOk = 1U << 7;
inline constexpr std::uint16_t kMovingError = 1U << 8;
inline constexpr std::uint16_t kHoldingError = 1U << 9;
}  // namespace io_bit

/// The polling status word. It is buffered twice: CPL clears what POL has reported only, so nothing that
/// happens between the two is lost.
class PollingStatus {
 public:
  void raise(std::uint16_t bits) { fresh_ = static_cast<std::uint16_t>(fresh_ | bits); }

  /// The word as POL answers it; its bits may be cleared from now on.
  std::uint16_t report() {
    reported_ = static_cast<std::uint16_t>(reported_ | fresh_);
    fresh_ = 0;
    return reported_;
  }

  void clear(std::uint16_t mask) { reported_ = static_cast<std::uint16_t>(reported_ & ~mask); }

 private:
  std::uint16_t fresh_ = 0;
  std::uint16_t reported_ = 0;
};

}  // namespace interpolated_motion::emulation
