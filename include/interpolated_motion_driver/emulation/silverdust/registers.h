#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace interpolated_motion::emulation {

/// Numbers of the data registers with a meaning of their own ("Interpolated Motion", QCI-TD044, Registers
/// Used with Interpolated Motion; 0 to 9 as hosts use them). All others are free for the user.
namespace silverdust_register {
inline constexpr std::int64_t kTargetPosition = 0;  ///< counts
inline constexpr std::int64_t kActualPosition = 1;  ///< counts
inline constexpr std::int64_t kPositionError = 6;   ///< low word: target - actual; high word: largest so far
inline constexpr std::int64_t kVelocity = 7;        ///< both words: 32767 is the full scale
inline constexpr std::int64_t kLastLive = 9;        ///< 0..9 belong to the drive and cannot be written
inline constexpr std::int64_t kAccumulator = 10;    ///< of calculation commands, which this drive lacks
inline constexpr std::int64_t kFirstUser = 11;
/// High word: the segment has been taken; low word: first of its 4 registers, 0: the queue.
inline constexpr std::int64_t kSegmentControl = 17;
inline constexpr std::int64_t kSegmentTime = 18;          ///< ticks left of the segment that is executed
inline constexpr std::int64_t kDefaultDeceleration = 19;  ///< when there is no fresh segment; scale of IMS
inline constexpr std::int64_t kProfilePosition = 20;      ///< 20..23: the segment that is executed
inline constexpr std::int64_t kProfileAcceleration = 21;
inline constexpr std::int64_t kProfileVelocity = 22;
inline constexpr std::int64_t kProfileDeceleration = 23;
inline constexpr std::int64_t kProfileOffset = 24;  ///< of profile moves, which this drive lacks
}  // namespace silverdust_register

/// The data registers of a drive as they are stored, 32 bit each; how hosts see them is in DataRegisters.
class RegisterFile {
 public:
  static constexpr std::int64_t kSize = 256;  ///< registers 0..255

  /// Whether there is a register `number`.
  static bool exists(std::int64_t number) { return number >= 0 && number < kSize; }

  /// Whether a host may write it.
  static bool writable(std::int64_t number) {
    return exists(number) && number > silverdust_register::kLastLive;
  }

  /// Whether `count` registers from `first` on are all the user's.
  static bool user(std::int64_t first, std::int64_t count) {
    using namespace silverdust_register;
    const std::int64_t last = first + count - 1;
    const bool apart = last < kSegmentControl || first > kProfileOffset;
    return first >= kFirstUser && exists(last) && apart;
  }

  /// `number` must exist.
  std::int32_t get(std::int64_t number) const { return values_[static_cast<std::size_t>(number)]; }
  void set(std::int64_t number, std::int32_t value) { values_[static_cast<std::size_t>(number)] = value; }

  /// All are 0, as after power-up.
  void clear() { values_.fill(0); }

 private:
  std::array<std::int32_t, kSize> values_{};
};

}  // namespace interpolated_motion::emulation
