#include "interpolated_motion_driver/axis/silverlode/segment_registers.h"

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::axis {

namespace registers = silverlode::registers;

std::optional<std::string> refuse_segment_registers(const SegmentRegisters& used) {
  constexpr std::size_t kFirstUser = 11;
  constexpr std::size_t kLastUser = 199;
  const std::size_t last = used.first + SegmentRegisters::kBlock * used.blocks - 1;
  const bool apart = last < registers::kImsControl || used.first > registers::kProfileOffset;
  if (used.blocks >= 1 && used.first >= kFirstUser && last <= kLastUser && apart) return std::nullopt;
  return fmt::format("is {}: {} blocks of four registers are {}..{} then, allowed are {}..{} and {}..{}",
                     used.first, used.blocks, used.first, last, kFirstUser, registers::kImsControl - 1,
                     registers::kProfileOffset + 1, kLastUser);
}

}  // namespace interpolated_motion::axis
