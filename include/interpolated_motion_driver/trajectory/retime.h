#pragma once

#include <limits>

#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/time_law.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Longest piece of a path while the rate of its law changes.
inline constexpr GoalTime kRetimedPiece{0.01};

/// What becomes of `nominal` by `law`, from goal time `from` on (from the begin of its motion if that is
/// later): path(t) = nominal(law(t)). Where the rate is constant that is exact but for rounding. Where it
/// changes the law's pieces must be no longer than `kRetimedPiece`; between their ends, where position,
/// velocity and acceleration are exact, the path is a quintic. Where the rate comes to 0 for good the path
/// ends. Nothing is needed of it behind `until`, where it may end as well.
Path retimed(const Path& nominal, const TimeLaw& law, GoalTime from,
             GoalTime until = GoalTime{std::numeric_limits<double>::infinity()});

}  // namespace interpolated_motion::trajectory
