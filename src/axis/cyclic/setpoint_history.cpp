#include "interpolated_motion_driver/axis/cyclic/setpoint_history.h"

#include <algorithm>

namespace interpolated_motion::axis {

void SetpointHistory::add(HostTime stamp, std::int32_t counts) {
  if (known_) {
    std::copy_backward(targets_.begin(), targets_.end() - 1, targets_.end());
    targets_[0] = {stamp, counts};
    return;
  }
  known_ = true;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    targets_[i] = {stamp - static_cast<int>(i) * period_, counts};
  }
}

trajectory::State SetpointHistory::at(HostTime when, const encoding::Transmission& transmission) const {
  if (!known_) return {};
  const HostTime t0 = targets_[1].stamp;
  interpolation::CipKnots knots;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    knots[i] = {seconds(targets_[i].stamp - t0), transmission.joint_position(targets_[i].counts)};
  }
  const interpolation::CipPolynomial demand = interpolation::cip_polynomial_through(order_, knots);
  const double tau = seconds(when - t0);
  return {demand.value(tau), demand.first_derivative(tau), demand.second_derivative(tau)};
}

}  // namespace interpolated_motion::axis
