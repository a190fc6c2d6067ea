#include <algorithm>
#include <cmath>

#include "implementation.h"

// What a host can read: registers and status words.
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

}  // namespace

std::int32_t SilverDust::Implementation::read_register(std::int64_t number) const {
  switch (number) {
    case kTargetPosition:
      return wrapped(profile_.counts());
    case kActualPosition:
      return position();
    case kPositionError:
      return error_register();
    case kVelocity:
      return velocity_register();
    default:
      return registers_.get(number);
  }
}

std::int32_t SilverDust::Implementation::error_register() const {
  return words(to_int16(largest_error_), to_int16(position_error()));
}

std::int32_t SilverDust::Implementation::velocity_register() const {
  const double share = axis_.velocity() / profile_.counts_per_tick_at_full_scale();
  const std::int64_t velocity = to_int16(std::llround(share * kVelocityFullScale));
  return words(velocity, velocity);
}

bool SilverDust::Implementation::set_register(std::int64_t number, std::int32_t value) {
  const bool segment = number == kSegmentTime || (number >= kProfilePosition && number <= kProfileOffset);
  if (segment && motion_ == Motion::Interpolated) return false;
  registers_.set(number, value);
  return true;
}

std::int64_t SilverDust::Implementation::position_error() const { return profile_.counts() - axis_.counts(); }

std::uint16_t SilverDust::Implementation::internal_status() const {
  const unsigned inputs = (parameters_.status_inputs & 7U) << status_bit::kInputs;
  const unsigned temperature = temperature_ok_ ? status_bit::kTemperatureOk : 0U;
  return static_cast<std::uint16_t>(latched_status_ | inputs | temperature);
}

std::uint16_t SilverDust::Implementation::io_word() const {
  unsigned word = (parameters_.io_inputs & 7U) << io_bit::kInputs;
  if (motion_ != Motion::None) word |= io_bit::kTrajectoryActive;
  if (temperature_ok_) word |= io_bit::kTemperatureOk;
  if ((latched_status_ & status_bit::kMovingError) != 0) word |= io_bit::kMovingError;
  if ((latched_status_ & status_bit::kHoldingError) != 0) word |= io_bit::kHoldingError;
  return static_cast<std::uint16_t>(word);
}

void SilverDust::Implementation::clear_internal_status() {
  latched_status_ = static_cast<std::uint16_t>(latched_status_ & ~status_bit::kLatched);
  temperature_ok_ = true;
  check_kill_conditions();
}

}  // namespace interpolated_motion::emulation
