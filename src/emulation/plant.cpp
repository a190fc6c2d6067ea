#include "interpolated_motion_driver/emulation/plant.h"

#include <cmath>

namespace interpolated_motion::emulation {

Plant::Plant(const PlantParameters& parameters, double position)
    : lag_(parameters.lag_ms), load_(parameters.load_counts), demand_(position), position_(position) {
  if (lag_ <= 0.0) return;
  rate_ = 2.0 / lag_;
  decay_ = std::exp(-rate_);
}

void Plant::stand() {
  demand_ = position_;
  velocity_ = 0.0;
}

void Plant::place(double position) {
  position_ = position;
  stand();
}

void Plant::set_stalled(bool stalled) {
  stalled_ = stalled;
  velocity_ = 0.0;
}

// A position loop around a velocity loop: velocity' = ((demand - position) / lag + fed velocity - velocity) *
// 4 / lag + fed acceleration. So feeding forward is the same as a demand that is ahead.
void Plant::follow(double demand, double velocity, double acceleration) {
  const double before = demand_;
  demand_ = demand + load_ + lag_ * velocity + 0.25 * lag_ * lag_ * acceleration;
  if (stalled_) return;
  const double slope = demand_ - before;
  if (lag_ <= 0.0) {
    velocity_ = slope;
    position_ = demand_;
    return;
  }
  // Against the demand's ramp the lag `lag * slope` is the steady state; what differs from it decays as (p +
  // q t) e^(-rate t).
  const double p = position_ - before + lag_ * slope;
  const double q = velocity_ - slope + rate_ * p;
  position_ = demand_ - lag_ * slope + (p + q) * decay_;
  velocity_ = slope + (q - rate_ * (p + q)) * decay_;
}

}  // namespace interpolated_motion::emulation
