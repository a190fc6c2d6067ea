#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace interpolated_motion::axis {

/// Where segments wait in a SilverLode drive (QCI-TD044).
enum class SegmentQueue {
  Fifo,       ///< the Interpolated Move Queue, written with IMW
  Registers,  ///< the register-based queue: user registers, handed over with register 17
};

/// The user registers of a register-based queue: `blocks` times four, one after the other.
struct SegmentRegisters {
  static constexpr std::size_t kBlock = 4;  ///< time, position, acceleration, velocity

  std::uint16_t first = 25;  ///< number of the first one; see refuse_segment_registers()
  std::size_t blocks = 2;    ///< used in turn; 1: the same registers for every segment
  int lost_replies = 1;      ///< in a row, that a goal must be able to bear at any time

  /// Number of the last one.
  std::uint16_t last() const { return static_cast<std::uint16_t>(first + kBlock * blocks - 1); }
  /// First register of the block of segment `number`, counted from 0.
  std::uint16_t block_of(std::size_t number) const {
    return static_cast<std::uint16_t>(first + kBlock * (number % blocks));
  }
};

/// Why `registers` cannot be used, with the allowed ranges; nothing when they can. User registers are 11 and
/// up; 17 to 24 belong to interpolated motion and to profile moves, 200 and up to the drive.
std::optional<std::string> refuse_segment_registers(const SegmentRegisters& registers);

}  // namespace interpolated_motion::axis
