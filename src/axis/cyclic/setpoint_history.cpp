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
  targets_[0] = {stamp, counts};
  rest_before(1);
}

void SetpointHistory::rest_before(std::size_t from) {
  for (std::size_t i = from; i < targets_.size(); ++i)
    targets_[i] = {targets_[i - 1].stamp - period_, targets_[i - 1].counts};
}

std::size_t SetpointHistory::drop(HostTime first, HostTime last) {
  if (!known_) return 0;
  const auto is_dropped = [&](const Target& target) {
    const HostTime sync = target.stamp - period_;
    return sync >= first && sync <= last;
  };
  const auto end = std::remove_if(targets_.begin(), targets_.end(), is_dropped);
  const auto kept = static_cast<std::size_t>(end - targets_.begin());
  known_ = kept > 0;
  if (known_) rest_before(kept);
  return targets_.size() - kept;
}

interpolation::CipKnots SetpointHistory::knots(HostTime origin,
                                               const encoding::Transmission& transmission) const {
  interpolation::CipKnots knots;
  for (std::size_t i = 0; i < knots.size(); ++i)
    knots[i] = {seconds(targets_[i].stamp - origin), transmission.joint_position(targets_[i].counts)};
  return knots;
}

trajectory::State SetpointHistory::at(HostTime when, const encoding::Transmission& transmission) const {
  if (!known_) return {};
  const HostTime t0 = targets_[1].stamp;
  const interpolation::CipPolynomial demand =
      interpolation::cip_polynomial_through(order_, knots(t0, transmission));
  const double tau = seconds(when - t0);
  return {demand.value(tau), demand.first_derivative(tau), demand.second_derivative(tau)};
}

}  // namespace interpolated_motion::axis
