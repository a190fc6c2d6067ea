#pragma once

#include <optional>
#include <string>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/joint_unit.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// Where a path leaves its limits: the extreme value of the first piece that does.
struct LimitViolation {
  Quantity quantity = Quantity::Position;  ///< decides the unit of the three values
  GoalTime time{0.0};                      ///< of that value
  double value = 0.0;                      ///< rad or m, per s, per s^2
  double minimum = 0.0;                    ///< allowed, in the same unit; slack not included
  double maximum = 0.0;                    ///< allowed, in the same unit; slack not included
  bool at_knot = false;                    ///< at the begin or end of a piece, else within one
  /// Where the path begins, if that is outside the limits of position (rad or m) and so is the violation.
  std::optional<double> begins_outside;
};

/// The first piece of `path` with a position, velocity or acceleration outside `limits`, in exact extrema,
/// i.e. between the knots too; nothing if the whole path is within. Positions of a continuous joint are not
/// limited. A NaN is outside. A path without pieces rests and is not checked. No allocation.
///
/// A path that begins outside the limits of position, where a joint has been pushed or left, may stand there
/// or move in: as long as it is outside it never moves farther out, and once it is inside it stays there.
std::optional<LimitViolation> find_limit_violation(const Path& path, const JointLimits& limits);

/// The same of positions alone.
std::optional<LimitViolation> find_position_violation(const Path& path, const JointLimits& limits);

/// The refusal for it: names joint, value in its unit, time, allowed range, whether a point asks for it
/// itself, the curve between two points does, or it is little enough to come from rounding, and what to do.
Refusal limit_refusal(const std::string& joint, JointUnit unit, const LimitViolation& violation);

}  // namespace interpolated_motion::trajectory
