#pragma once

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Shortest motion the driver adds of its own (lead-in, stop): 20 interpolator samples of an EPOS drive,
/// enough for the records of a start and an end.
inline constexpr GoalTime kShortestMotion{0.020};

/// Least duration of the quintic `rest_to_rest` over `distance` (rad or m, any sign) within `part` (0 < part
/// <= 1) of the velocity and acceleration limits: its peak velocity is 15/8 distance/T, its peak acceleration
/// 10/sqrt(3) distance/T^2. 0 for a distance of 0 or without limits.
GoalTime rest_to_rest_duration(double distance, const JointLimits& limits, double part = 1.0);

/// Motion from rest at `from` to rest at `to`, beginning at `start`, in `duration` (> 0), with velocity and
/// acceleration zero at both ends and no overshoot.
Piece rest_to_rest(double from, double to, GoalTime start, GoalTime duration);

}  // namespace interpolated_motion::trajectory
