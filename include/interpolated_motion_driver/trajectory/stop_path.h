#pragma once

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Path that continues `from` at goal time `start` and brings its velocity to zero, never reversing, with an
/// acceleration of at most `limits.max_acceleration` (> 0). The velocity falls as v (1 - 3 s^2 + 2 s^3): no
/// step in acceleration but that of `from` itself, whose acceleration is not continued. Takes 1.5 |v| /
/// max_acceleration, at least `kShortestMotion`, and half of that times v in distance. The position limits
/// are not regarded: `find_limit_violation` tells whether the stop fits. A joint at rest gets a path without
/// pieces. Throws std::invalid_argument if `max_acceleration` is not positive.
Path stop_path(const State& from, GoalTime start, const JointLimits& limits);

/// As stop_path, but the shortest: constant deceleration, with a step in acceleration at both ends. Takes
/// |v| / max_acceleration and half of that times v in distance. A path within its limits of position and
/// acceleration can be left so at any point without leaving the limits of position.
Path shortest_stop_path(const State& from, GoalTime start, const JointLimits& limits);

}  // namespace interpolated_motion::trajectory
