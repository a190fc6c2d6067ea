#include "interpolated_motion_driver/trajectory/rest_to_rest.h"

#include <algorithm>
#include <cmath>

#include "interpolated_motion_driver/trajectory/hermite.h"

namespace interpolated_motion::trajectory {

GoalTime rest_to_rest_duration(double distance, const JointLimits& limits, double part) {
  constexpr double kPeakVelocity = 15.0 / 8.0;
  const double peak_acceleration = 10.0 / std::sqrt(3.0);
  const double length = std::abs(distance);
  const double by_velocity = kPeakVelocity * length / (part * limits.max_velocity);
  const double by_acceleration = std::sqrt(peak_acceleration * length / (part * limits.max_acceleration));
  return GoalTime(std::max(by_velocity, by_acceleration));
}

Piece rest_to_rest(double from, double to, GoalTime start, GoalTime duration) {
  const GoalTime end = start + duration;
  return {start, end, quintic_hermite({from, 0.0, 0.0}, {to, 0.0, 0.0}, (end - start).count())};
}

}  // namespace interpolated_motion::trajectory
