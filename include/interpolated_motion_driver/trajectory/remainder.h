#pragma once

#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// What is left of `path` from goal time `from` on, told by another clock: that instant is 0 on it, and one
/// of its seconds is `rate` > 0 seconds of goal time. A path of one position when it ends at or before
/// `from`; `from` must not be before its start.
Path remainder(const Path& path, GoalTime from, double rate);

}  // namespace interpolated_motion::trajectory
