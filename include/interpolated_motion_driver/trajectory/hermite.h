#pragma once

#include "interpolated_motion_driver/trajectory/polynomial.h"

namespace interpolated_motion::trajectory {

/// The cubic that leaves `from` and arrives at `to` after `duration` s (> 0) in position and velocity.
Polynomial cubic_hermite(const State& from, const State& to, double duration);

/// The quintic that leaves `from` and arrives at `to` after `duration` s (> 0) in position, velocity and
/// acceleration.
Polynomial quintic_hermite(const State& from, const State& to, double duration);

/// The quintic that leaves `from`, in position, velocity and acceleration, and arrives at the position and
/// velocity of `to` after `duration` s (> 0) without jerk: of all such ways the one with the least jerk.
Polynomial least_jerk(const State& from, const State& to, double duration);

}  // namespace interpolated_motion::trajectory
