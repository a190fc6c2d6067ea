#pragma once

#include <cstdint>

namespace interpolated_motion::emulation {

/// Bits of the polling status word (PSW, answered to POL and POR; QuickSilver "Polling", QCI-TD045).
namespace polling_bit {
inline constexpr std::uint16_t kAborted = 1U << 0;         ///< a packet was cut short by an '@'
inline constexpr std::uint16_t kShutDown = 1U << 3;        ///< by a kill motor condition (KMC)
inline constexpr std::uint16_t kTooLong = 1U << 5;         ///< a packet had too many numbers
inline constexpr std::uint16_t kStatusCheck = 1U << 6;     ///< condition of CKS met
inline constexpr std::uint16_t kMovingError = 1U << 8;     ///< ERL's moving limit was exceeded
inline constexpr std::uint16_t kHoldingError = 1U << 9;    ///< ERL's holding limit was exceeded
inline constexpr std::uint16_t kVoltage = 1U << 10;        ///< the supply was too low or too high
inline constexpr std::uint16_t kCommandError = 1U << 12;   ///< a command was acknowledged but not obeyed
inline constexpr std::uint16_t kDone = 1U << 13;           ///< a program class command or a motion is over
inline constexpr std::uint16_t kImmediateDone = 1U << 15;  ///< an immediate command is done
}  // namespace polling_bit

/// The polling status word. Its bits stay until CPL clears them. It is buffered twice: CPL clears what POL
/// has reported only, so nothing that happens between the two is lost ("Polling", QCI-TD045).
class PollingStatus {
 public:
  /// Something has happened: `bits` of polling_bit.
  void raise(std::uint16_t bits) { fresh_ = static_cast<std::uint16_t>(fresh_ | bits); }

  /// The word as POL answers it; its bits may be cleared from now on.
  std::uint16_t report() {
    reported_ = static_cast<std::uint16_t>(reported_ | fresh_);
    fresh_ = 0;
    return reported_;
  }

  /// CPL: clears the bits of `mask` that have been reported.
  void clear(std::uint16_t mask) { reported_ = static_cast<std::uint16_t>(reported_ & ~mask); }

 private:
  std::uint16_t fresh_ = 0;
  std::uint16_t reported_ = 0;
};

}  // namespace interpolated_motion::emulation
