#pragma once

#include <vector>

#include "interpolated_motion_driver/motion/axes.h"
#include "interpolated_motion_driver/motion/course.h"
#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// A goal to be planned from `rest`, where the axes rest or are going to, `now` or later.
PlanningPtr planning_from_rest(const Axes& axes, GoalPtr goal, const trajectory::GoalRules& rules,
                               const std::vector<trajectory::State>& rest, HostTime now);

/// A goal to be planned behind what the axes are committed to, which can be changed from goal time `until`
/// on; at its stamp if that is later. `linger`: rest behind it before the drives leave.
PlanningPtr planning_to_join(const Axes& axes, GoalPtr goal, const trajectory::GoalRules& rules,
                             const Course& course, GoalTime until, GoalTime linger, HostTime now);

/// Where `joint` is at the first point of `goal`; `otherwise` where that does not say.
double first_position(const trajectory::Goal& goal, const std::string& joint, double otherwise);

}  // namespace interpolated_motion::motion
