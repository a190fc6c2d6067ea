#pragma once

#include <cstddef>
#include <vector>

#include "interpolated_motion_driver/motion/active_goal.h"
#include "interpolated_motion_driver/motion/axes.h"
#include "interpolated_motion_driver/motion/course.h"
#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/trajectory/speed_change.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// A goal to be planned from `rest`, where the axes rest or are going to, `now` or later.
PlanningPtr planning_from_rest(const Axes& axes, GoalPtr goal, const trajectory::GoalRules& rules,
                               const trajectory::Speed& speed, const std::vector<trajectory::State>& rest,
                               HostTime now);

/// A goal to be planned behind what the axes are committed to, which can be changed from goal time `until`
/// on; at its stamp if that is later. `linger`: rest behind it before the drives leave.
PlanningPtr planning_to_join(const Axes& axes, GoalPtr goal, const trajectory::GoalRules& rules,
                             const trajectory::Speed& speed, const Course& course, GoalTime until,
                             GoalTime linger, HostTime now);

/// The motion under way, which ends at nominal time `end`, at another speed behind what the axes are
/// committed to, from goal time `until` on.
PlanningPtr planning_of_speed(const Axes& axes, const trajectory::GoalRules& rules,
                              const trajectory::Speed& speed, const Course& course, GoalTime until,
                              GoalTime end, GoalTime linger, HostTime now);

/// The motion of a goal that is paused, from where the axes rest now.
PlanningPtr planning_to_resume(const Axes& axes, const trajectory::GoalRules& rules,
                               const trajectory::Speed& speed, const ActiveGoal& paused, HostTime now);

/// Where the joint of that number is at the first point of `goal`, or at the limit that this is beyond;
/// `otherwise` where the goal does not say.
double first_position(const trajectory::Goal& goal, const trajectory::GoalRules& rules, std::size_t joint,
                      double otherwise);

}  // namespace interpolated_motion::motion
