#include "interpolated_motion_driver/emulation/silverdust/data_registers.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::emulation {

using namespace silverdust_register;

namespace {

constexpr double kVelocityFullScale = 32767.0;  // of register 7

std::int32_t wrapped(std::int64_t counts) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(counts)));
}

std::int64_t to_int16(std::int64_t value) { return std::clamp<std::int64_t>(value, -32'768, 32'767); }

std::int32_t words(std::int64_t high, std::int64_t low) {
  const auto bits =
      static_cast<std::uint32_t>(high & 0xFFFF) << 16 | static_cast<std::uint32_t>(low & 0xFFFF);
  return static_cast<std::int32_t>(bits);
}

bool is_of_segment(std::int64_t number) {
  return number == kSegmentTime || (number >= kProfilePosition && number <= kProfileDeceleration);
}

}  // namespace

std::int32_t DataRegisters::read(std::int64_t number) const {
  switch (number) {
    case kTargetPosition:
      return target_position();
    case kActualPosition:
      return axis_.reading();
    case kPositionError:
      return position_error();
    case kVelocity:
      return velocity();
    default:
      return registers_.get(number);
  }
}

std::int32_t DataRegisters::target_position() const {
  if (motion_.interpolating() && !replies_.target_in_motion) return registers_.get(kProfilePosition);
  return wrapped(motion_.target().counts());
}

std::int32_t DataRegisters::position_error() const {
  return words(to_int16(limits_.largest()), to_int16(motion_.target().counts() - axis_.counts()));
}

std::int32_t DataRegisters::velocity() const {
  const double share = axis_.velocity() / motion_.target().counts_per_tick_at_full_scale();
  const std::int64_t velocity = to_int16(std::llround(share * kVelocityFullScale));
  return words(velocity, velocity);
}

bool DataRegisters::write(std::int64_t number, std::int32_t value) {
  const bool in_use = is_of_segment(number) && motion_.interpolating();
  if (in_use && replies_.segment_writes == SegmentWriteReply::CommandError) return false;
  registers_.set(number, value);
  if (in_use) motion_.follow_registers();
  return true;
}

}  // namespace interpolated_motion::emulation
