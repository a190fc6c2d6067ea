#pragma once

#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// How a joint brakes.
struct Braking {
  double max_acceleration = 0.0;  ///< per s^2, > 0
  GoalTime ramp{0.0};             ///< in which the acceleration goes from 0 to max_acceleration, > 0
};

/// Path that continues `from` at goal time `start`, in position, velocity and acceleration, and brings it to
/// rest: the acceleration is ramped to the deceleration, held, and ramped to 0. It is the quickest with the
/// jerk max_acceleration / ramp and without more acceleration than max_acceleration (or than `from` has
/// already); it takes |v| / max_acceleration + ramp from a joint without acceleration. Where `from` brakes so
/// hard that such ramps would turn it round, the jerk is up to `kHardestRamp` times that; what is left of the
/// turning round is a motion back and to rest. The position limits are not regarded: `find_limit_violation`
/// tells whether the stop fits. A joint at rest gets a path without pieces. Throws std::invalid_argument if
/// `braking` is out of its ranges.
Path jerk_limited_stop(const State& from, GoalTime start, const Braking& braking);

inline constexpr double kHardestRamp = 4.0;

}  // namespace interpolated_motion::trajectory
