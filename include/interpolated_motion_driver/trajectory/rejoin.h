#pragma once

#include <optional>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Path of a joint that has been led astray: from `from` at goal time `start` a quintic back to `path`, in
/// position, velocity and acceleration, and on along it. The bridge is the shortest of `shortest`, longer by
/// a half, and so on, at most `longest`, that keeps `limits` with `margin` (>= 1) as a factor of velocity and
/// acceleration. Nothing if none does: then the joint has to be stopped. Positions and velocity are
/// allowed what `from` is beyond their limits already.
std::optional<Path> rejoin(const Path& path, const State& from, GoalTime start, const JointLimits& limits,
                           double margin, GoalTime shortest, GoalTime longest);

}  // namespace interpolated_motion::trajectory
