#pragma once

#include <optional>
#include <string>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// How far a path may be beyond a limit, for what is left of a value at the limit after printing and rounding
/// (toppra gives 2.5000147 at a limit of 2.5): positions in rad or m, velocities and accelerations as a part
/// of the limit.
inline constexpr double kPositionSlack = 1e-6;
inline constexpr double kRateSlack = 1e-4;

/// What a limit or a tolerance is about: in rad or m, per s, per s^2.
enum class Quantity { Position, Velocity, Acceleration };

/// "position", "velocity" or "acceleration".
const char* name(Quantity quantity);

/// Where a path leaves its limits: the extreme value of the first piece that does.
struct LimitViolation {
  Quantity quantity = Quantity::Position;  ///< decides the unit of the three values
  GoalTime time{0.0};                      ///< of that value
  double value = 0.0;                      ///< rad or m, per s, per s^2
  double minimum = 0.0;                    ///< allowed, in the same unit; slack not included
  double maximum = 0.0;                    ///< allowed, in the same unit; slack not included
};

/// The first piece of `path` with a position, velocity or acceleration outside `limits`, in exact extrema,
/// i.e. between the knots too; nothing if the whole path is within. Positions of a continuous joint are not
/// limited. A NaN is outside. A path without pieces rests and is not checked. No allocation.
std::optional<LimitViolation> find_limit_violation(const Path& path, const JointLimits& limits);

/// The refusal for it: names joint, value, time, allowed range, and what to do.
Refusal limit_refusal(const std::string& joint, const LimitViolation& violation);

}  // namespace interpolated_motion::trajectory
