#pragma once

#include <functional>
#include <optional>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Where a drive that goes on along a path would leave the joint's limits with what it makes of it; nothing
/// if it keeps them.
using DemandCheck = std::function<std::optional<LimitViolation>(const Path&)>;

/// How one joint follows a stream of setpoints.
struct StreamRules {
  JointLimits limits;           ///< velocity and acceleration must be finite
  GoalTime ride_through{0.06};  ///< goes on at the velocity of the newest setpoint for so long, then brakes
  GoalTime catch_up{0.5};       ///< longest it may be behind the stream after late or lost setpoints
  /// Of the drive; none: what it makes of a path within the limits is within them.
  DemandCheck demand;
};

/// A setpoint of one joint: `position` is passed at `time` with `velocity`.
struct StreamTarget {
  GoalTime time{0.0};     ///< at which it is to be passed
  double position = 0.0;  ///< rad or m
  double velocity = 0.0;  ///< per s, signed
};

/// The path from `from` at `start` through a setpoint, to go on with while no further one comes:
/// - a cubic to the setpoint, in position and velocity. If the limits do not allow that in time, it meets the
///   stream later, where it will be at the setpoint's velocity: by the shortest delay that the search finds,
///   at most `catch_up` later than that, or than `start`;
/// - straight on for `ride_through`, then a smooth stop; the limits of position may shorten either.
///
/// Where the drive does not make a motion within the limits of that (`rules.demand`), the acceleration goes
/// on without a step instead: a quintic to the setpoint, without acceleration there or of the least jerk, and
/// behind it ramps; and later, as above.
///
/// So there is always a stop behind the newest setpoint, and a fresh one leaves the path at any point without
/// a step in position or velocity. `target.time` may lie before `start`. The limit that fails with the
/// longest delay is returned when there is no such path.
Expected<Path, LimitViolation> stream_path(const State& from, GoalTime start, const StreamTarget& target,
                                           const StreamRules& rules);

/// `path`, at rest at its end, and behind it a rest of `duration`.
Path with_rest(const Path& path, GoalTime duration);

/// When a joint has come to rest for good, in the time of its path.
GoalTime rest_begin(const Path& path);

/// `path`, `by` later.
Path shifted(const Path& path, GoalTime by);

/// The pieces of `path` from those at `begin` on, cut off at `end`, and `rest` behind, which must start there
/// (but for rounding).
Path splice(const Path& path, GoalTime begin, GoalTime end, const Path& rest);

}  // namespace interpolated_motion::trajectory
