#include "interpolated_motion_driver/emulation/silverdust/axis.h"

#include <cmath>

namespace interpolated_motion::emulation {
namespace {

// Far below what an encoder shows: closer than this the axis is where it should be.
constexpr double kSettled = 1.0 / 1024.0;  // counts

}  // namespace

LaggingAxis::LaggingAxis(const SilverDustPlant& parameters)
    : gain_(parameters.lag_ticks > 0.0 ? 1.0 - std::exp(-1.0 / parameters.lag_ticks) : 1.0) {}

void LaggingAxis::follow(double target) {
  if (stalled_) return stand();
  const double error = target - position_;
  velocity_ = std::abs(error) < kSettled ? error : error * gain_;
  position_ = std::abs(error) < kSettled ? target : position_ + velocity_;
}

void LaggingAxis::place(double position) {
  position_ = position;
  velocity_ = 0.0;
}

std::int64_t LaggingAxis::counts() const { return std::llround(position_); }

std::int32_t LaggingAxis::reading() const {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(counts()));
}

}  // namespace interpolated_motion::emulation
