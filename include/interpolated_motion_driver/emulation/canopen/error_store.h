#pragma once

#include <array>
#include <cstdint>

namespace interpolated_motion::emulation {

/// Data of an EMCY message: error code (LE), error register, five manufacturer bytes, which EPOS leaves 0
/// (CiA 301, 7.2.7).
using EmergencyBytes = std::array<std::uint8_t, 8>;

/// Error register 0x1001 and error history 0x1003 of the drive.
class ErrorStore {
 public:
  static constexpr int kDepth = 5;  ///< entries of 0x1003, as EPOS2's EDS has them

  /// Notes an error. Returns the data of the EMCY message to be sent.
  EmergencyBytes raise(std::uint16_t code, std::uint8_t error_register);

  /// All errors are gone. Returns the data of the EMCY message "error reset" to be sent.
  EmergencyBytes reset();

  /// An error has been raised and not been reset since; 0x1001 has the bits of all of those, bit 0 with each.
  bool any() const { return register_ != 0; }
  std::uint8_t error_register() const { return register_; }

  /// 0x1003:0, 0..kDepth; reset() leaves the history.
  int history_size() const { return size_; }

  /// Entry 1 (newest) .. kDepth of the history, 0 where there is none.
  std::uint32_t history(int entry) const { return history_[static_cast<std::size_t>(entry - 1)]; }
  /// 0 has been written to 0x1003:0. The error register stays.
  void clear_history();

 private:
  std::uint8_t register_ = 0;
  int size_ = 0;
  std::array<std::uint32_t, kDepth> history_{};
};

}  // namespace interpolated_motion::emulation
