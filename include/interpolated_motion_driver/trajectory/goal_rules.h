#pragma once

#include <string>
#include <vector>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/joint_unit.h"

namespace interpolated_motion::trajectory {

/// Shortest step between two points, and the time up to which a first point counts as the start. SilverLode
/// drives have the finest time of all that are served, a servo tick of 120 us: nothing can be asked of a
/// drive within 100 us.
inline constexpr GoalTime kMinimumStep{1e-4};

/// Largest move (rad, see in_unit()) of any joint that may be dropped when two points closer than
/// `kMinimumStep` become one: a fifth of an encoder count at 200 000 counts a turn.
inline constexpr double kMergeDistance = 1e-6;

/// A velocity (rad/s, see in_unit()) below this at the start or the end of a goal counts as rest. Planners
/// leave 1e-7 to 1e-4 there (moveit2 #3561); a drive loses 1e-3 rad/s in one sample of 1 ms at 1 rad/s^2.
inline constexpr double kRestVelocity = 1e-3;

/// That, rad/s or m/s.
inline double rest_velocity(JointUnit unit) { return in_unit(unit, kRestVelocity); }

/// An acceleration (rad/s^2, see in_unit()) below this at the start or the end of a goal counts as zero.
inline constexpr double kRestAcceleration = 1e-3;

/// What a goal is held against. The vectors have one entry per joint, in the order of `joints`.
struct GoalRules {
  std::vector<std::string> joints;  ///< all of the group; a goal may name them in another order
  std::vector<JointLimits> limits;  ///< of whole paths, between the points too
  /// How far (rad or m) the first point of a goal may be from the present position.
  std::vector<double> start_tolerance;
  /// Deviation (rad or m) from the first point below which no lead-in is needed, e.g. one encoder count.
  std::vector<double> lead_in_threshold;
  /// Accept goals that name some of the joints only; the others rest where they are.
  bool allow_partial_joints = false;
  /// Where the first point cannot be reached in time within the limits, it and all others are met that much
  /// later; else such a goal is refused.
  bool join_late = false;
  /// How much more time than the limits ask for a lead-in takes, >= 0; with `join_late`, how much later at
  /// least the points are met where the way to the first one begins at the present positions. For drives that
  /// interpolate by themselves.
  GoalTime least_late{0.0};
  /// The joints were braking when the goal was sent, and have come to rest since. A first point at time 0 out
  /// of tolerance is then left out, as for joints in motion.
  bool sent_in_motion = false;
  /// The goal was accepted when it could still be met, and its time has gone by since, in waiting for rest:
  /// its last point at least is met, however late.
  bool keep_last_point = false;
  /// A goal whose stamp is further ahead is refused: no planner waits so long, but a clock that is wrong may
  /// say so.
  GoalTime max_start_ahead{3600.0};
};

}  // namespace interpolated_motion::trajectory
