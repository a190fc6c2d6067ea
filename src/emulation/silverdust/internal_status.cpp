#include "interpolated_motion_driver/emulation/silverdust/internal_status.h"

namespace interpolated_motion::emulation {
namespace {

constexpr unsigned kThreeInputs = 7;

}  // namespace

void InternalStatus::restart() {
  latched_ = kPowerUp;
  temperature_ok_ = true;
}

bool InternalStatus::latch(std::uint16_t bits) {
  const bool known = (latched_ & bits) == bits;
  latched_ = static_cast<std::uint16_t>(latched_ | bits);
  return !known;
}

void InternalStatus::clear() {
  latched_ = static_cast<std::uint16_t>(latched_ & ~status_bit::kLatched);
  temperature_ok_ = true;
}

std::uint16_t InternalStatus::word() const {
  const unsigned inputs = (status_inputs_ & kThreeInputs) << status_bit::kInputs;
  const unsigned temperature = temperature_ok_ ? status_bit::kTemperatureOk : 0U;
  return static_cast<std::uint16_t>(latched_ | inputs | temperature);
}

std::uint16_t InternalStatus::io_word(bool trajectory_active) const {
  unsigned word = (io_inputs_ & kThreeInputs) << io_bit::kInputs;
  if (trajectory_active) word |= io_bit::kTrajectoryActive;
  if (temperature_ok_) word |= io_bit::kTemperatureOk;
  if ((latched_ & status_bit::kMovingError) != 0) word |= io_bit::kMovingError;
  if ((latched_ & status_bit::kHoldingError) != 0) word |= io_bit::kHoldingError;
  return static_cast<std::uint16_t>(word);
}

}  // namespace interpolated_motion::emulation
