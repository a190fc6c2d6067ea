#include "interpolated_motion_driver/emulation/cyclic/fine_interpolation.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::emulation {

void FineInterpolation::enter(double position) {
  following_ = false;
  missed_ = 0;
  for (Knot& knot : knots_) knot = {0.0, position, 0.0, 0.0};
}

void FineInterpolation::set_grid(double period, double gain) {
  period_ = period;
  gain_ = gain;
}

void FineInterpolation::update(double position, double now) {
  if (!following_) {
    // The rest before the motion is history too.
    for (std::size_t i = 0; i < kKnots; ++i) knots_[i].time = now - static_cast<double>(i) * period_;
    following_ = true;
    return shift_in({now + period_, position, 0.0, 0.0});
  }
  // The newest was to be reached one period after it came, which is when the next one is expected.
  const double expected = knots_[0].time;
  const double periods = std::floor((now - expected) / period_ + 0.5);
  if (periods < 0.0) {
    knots_[0].position = position;
    return;
  }
  missed_ += static_cast<std::uint32_t>(periods);
  const double deviation = now - expected - periods * period_;
  shift_in({expected + (periods + 1.0) * period_ + gain_ * deviation, position, 0.0, 0.0});
}

void FineInterpolation::shift_in(const Knot& knot) {
  for (std::size_t i = kKnots - 1; i > 0; --i) knots_[i] = knots_[i - 1];
  knots_[0] = knot;
}

std::uint32_t FineInterpolation::missed_now(double now) const {
  const double periods = std::floor((now - knots_[0].time) / period_ + 0.5);
  return following_ && periods > 0.0 ? static_cast<std::uint32_t>(periods) : 0U;
}

bool FineInterpolation::beyond(int updates, double now) const {
  return following_ && now > knots_[0].time + updates * period_;
}

void FineInterpolation::feed_forward(double velocity, double torque) {
  knots_[0].velocity = velocity;
  knots_[0].torque = torque;
}

MotionState FineInterpolation::at(double now) const {
  if (!following_) return {knots_[0].position, 0.0, 0.0};
  return through(&Knot::position, order_, now);
}

double FineInterpolation::velocity_at(double now) const {
  return following_ ? through(&Knot::velocity, std::min<std::size_t>(order_, 2), now).position : 0.0;
}

double FineInterpolation::torque_at(double now) const {
  return following_ ? through(&Knot::torque, 1, now).position : 0.0;
}

MotionState FineInterpolation::through(double Knot::*value, std::size_t order, double now) const {
  const std::size_t newest = now < knots_[1].time ? 1 : 0;
  std::array<MotionState, kKnots> p{};
  for (std::size_t i = 0; i <= order; ++i) p[i].position = knots_[newest + i].*value;
  // Neville: p[i] of level n passes through the knots i .. i + n; the derivatives of the same recursion.
  for (std::size_t level = 1; level <= order; ++level) {
    for (std::size_t i = 0; i + level <= order; ++i) {
      const double to_near = now - knots_[newest + i].time;
      const double to_far = now - knots_[newest + i + level].time;
      const double span = to_far - to_near;
      const MotionState a = p[i];
      const MotionState b = p[i + 1];
      p[i].position = (to_far * a.position - to_near * b.position) / span;
      p[i].velocity = (to_far * a.velocity + a.position - to_near * b.velocity - b.position) / span;
      p[i].acceleration =
          (to_far * a.acceleration + 2 * a.velocity - to_near * b.acceleration - 2 * b.velocity) / span;
    }
  }
  return p[0];
}

}  // namespace interpolated_motion::emulation
