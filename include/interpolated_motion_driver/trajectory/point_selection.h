#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// What is left of a goal after the points in the past were dropped.
struct FuturePoints {
  std::size_t first = 0;  ///< index of the first point that is kept
  GoalTime skipped{0.0};  ///< time of the plan = time of the goal - `skipped`
  GoalTime late{0.0};     ///< by which the points are met later than the goal's stamp says
  std::string warning;    ///< joint_trajectory_controller's words if points were dropped, else empty
};

/// Drops the points of a goal with a stamp that lie at or before `now`, as joint_trajectory_controller does.
/// `skipped` is how long ago the stamp was then. With no stamp, or one to come, nothing is dropped. `goal`
/// must have points with increasing times. Where no point is left, the goal is refused (InvalidGoal); with
/// `keep_last` its last point is kept instead, and met late, `kShortestMotion` from now.
Expected<FuturePoints, Refusal> drop_past_points(const Goal& goal, HostTime now, bool keep_last = false);

/// The refusal of joint_trajectory_controller for a goal none of whose `count` points can be reached any
/// more, the last `late` in the past, and `sentence` after it.
Refusal all_points_past(std::size_t count, GoalTime late, const std::string& sentence);

/// Indices of the points from `first` on that a path can go through: of points closer than `kMinimumStep`
/// (planners end with steps of nanoseconds: tesseract #381, moveit #3583) one is kept, the last point always
/// and else the earlier, if no joint moves more than `kMergeDistance`, in its unit, between them. Refused
/// (InvalidGoal) if one does, naming points, joint and distance. At least one index is returned. `goal` must
/// be well formed
/// (`validate_goal`) and `first` one of its points.
Expected<std::vector<std::size_t>, Refusal> merge_near_points(const Goal& goal, const GoalRules& rules,
                                                              std::size_t first);

}  // namespace interpolated_motion::trajectory
