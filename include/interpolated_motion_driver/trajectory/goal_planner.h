#pragma once

#include <string>
#include <vector>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// A goal that may be executed as it is: checked whole, from the present states to rest. Time 0 of the plan
/// is the goal's stamp if that is still to come, else any time from now on. All paths start at -`lead_in` (at
/// 0 without one) and end at `duration`.
struct GoalPlan {
  std::vector<Path> paths;  ///< in the order of `GoalRules::joints`
  std::vector<bool> named;  ///< of each joint, by the goal; the path of another one rests
  bool bridge = false;      ///< the paths begin at the present states, and not at the first point
  GoalTime lead_in{0.0};    ///< length of the move to the first point, in whole ms; 0 or at least 20 ms
  GoalTime duration{0.0};   ///< goal time of the last point, > 0
  /// What was cut off because the goal's stamp was in the past when it was planned: a point at time t of the
  /// goal is at t - `skipped` of the plan. 0 for a goal without stamp or one that starts later; less by what
  /// all points are met late (`GoalRules::join_late`).
  GoalTime skipped{0.0};
  std::vector<std::string> warnings;  ///< for the log: the goal is executed, though not to the letter
};

/// Plans `goal` for joints that are in the states `present` at `now` (one per joint of `rules`).
///
/// At rest:
/// - First point at time 0 (earlier than `kMinimumStep`): the start. It must be within `start_tolerance` of
///   the present position; if any joint is farther than `lead_in_threshold`, all joints first move there,
///   rest to rest, at no more than half of their limits, in -`lead_in` .. 0
///   (`GoalRules::least_late` makes that longer). Nearer than that the path begins at the point itself.
/// - First point at time 0 with a velocity above `kRestVelocity`: it cannot be met from rest. As in
///   joint_trajectory_controller the present state takes its place; a warning says so. Likewise one that is
///   out of tolerance for joints that were braking when the goal was sent (`GoalRules::sent_in_motion`).
/// - First point later: the path bridges from rest at the present position, beginning at 0.
///   `start_tolerance` does not apply, the limits do.
/// While any joint is in motion (as joint_trajectory_controller):
/// - A first point at time 0 cannot be met: the present states take its place.
/// - The path bridges from the present states to the first point that is left, at its time.
/// - Joints that the goal does not name are planned as if they rested: what they do is up to the caller.
///
/// A way to the first point for which there is too little time, from rest or in motion, is refused with the
/// least time that it would take; with `GoalRules::join_late` it gets that time, all points are met so much
/// later, and a warning says so. So is the last point with `GoalRules::keep_last_point`, where the time of
/// all points has gone by.
///
/// Always:
/// - Positions of a continuous joint are shifted, all alike, by the multiple of 2 pi that brings the first
///   point nearest to the present position. At half a turn (`kHalfTurnTolerance`) it is the smaller one: the
///   joint moves as the numbers say, and does not wind up.
/// - The last point must be at rest (`kRestVelocity`).
/// - The whole path of every named joint is within `limits`, between the points too.
///
/// Returns the refusal otherwise: codes and words of joint_trajectory_controller, then a sentence of our own.
/// A goal without points is refused here: it is a request to stop (see `is_stop_request`). Cost is linear in
/// the number of points. Throws std::invalid_argument when the vectors of `rules` and `present` do not have
/// one entry per joint.
Expected<GoalPlan, Refusal> plan_goal(const Goal& goal, const GoalRules& rules,
                                      const std::vector<State>& present, HostTime now);

}  // namespace interpolated_motion::trajectory
