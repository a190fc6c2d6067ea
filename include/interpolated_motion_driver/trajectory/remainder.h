#pragma once

#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// The part of `path` from goal time `from` (not before its start) on, in a time of its own: 0 is that
/// instant, and a second of it is `rate` > 0 seconds of goal time. So velocities are `rate`, accelerations
/// `rate`^2 times those of `path`. When `path` ends at or before `from`: a path that rests at its final
/// position.
Path remainder(const Path& path, GoalTime from, double rate);

}  // namespace interpolated_motion::trajectory
