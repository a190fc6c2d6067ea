#include "interpolated_motion_driver/motion/begin_planning.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace interpolated_motion::motion {

namespace {

Planning::AxisPart part_of(const axis::Axis& axis, axis::TailEncoderPtr encoder) {
  return {axis.bus(), axis.record_bus_time(), axis.bus_watch(), std::move(encoder)};
}

PlanningPtr planning_of(GoalPtr goal, const trajectory::GoalRules& rules, HostTime now) {
  auto planning = std::make_shared<Planning>();
  planning->goal = std::move(goal);
  planning->rules = rules;
  planning->now = now;
  return planning;
}

}  // namespace

PlanningPtr planning_from_rest(const Axes& axes, GoalPtr goal, const trajectory::GoalRules& rules,
                               const std::vector<trajectory::State>& rest, HostTime now) {
  PlanningPtr planning = planning_of(std::move(goal), rules, now);
  planning->present = rest;
  const GoalTime wait = wait_after_signal(axes);
  for (std::size_t i = 0; i < axes.size(); ++i)
    planning->axes.push_back(part_of(*axes[i], axes[i]->encoder_at_rest(rest[i].position, wait)));
  return planning;
}

PlanningPtr planning_to_join(const Axes& axes, GoalPtr goal, const trajectory::GoalRules& rules,
                             const Course& course, GoalTime until, GoalTime linger, HostTime now) {
  const GoalTime present = axes.front()->playback(now);
  const HostTime earliest = now + host_duration((until - present).count());
  const HostTime when = goal->start ? std::max(earliest, *goal->start) : earliest;
  PlanningPtr planning = planning_of(std::move(goal), rules, when);
  planning->entry = Planning::Entry::Join;
  planning->joining.join = until + GoalTime{seconds(when - earliest)};
  planning->joining.present = present;
  planning->joining.kept = oldest_playback(axes, now) - kKept;
  planning->joining.linger = linger;
  planning->joining.paths = course.paths();
  planning->present = course.at(planning->joining.join);
  for (const axis::Axis* axis : axes)
    planning->axes.push_back(part_of(*axis, axis->encoder_behind(axis::Pace::Goal)));
  return planning;
}

double first_position(const trajectory::Goal& goal, const std::string& joint, double otherwise) {
  const auto name = std::find(goal.joint_names.begin(), goal.joint_names.end(), joint);
  const auto number = static_cast<std::size_t>(name - goal.joint_names.begin());
  const std::vector<double>& positions = goal.points.front().positions;
  return number < positions.size() && std::isfinite(positions[number]) ? positions[number] : otherwise;
}

}  // namespace interpolated_motion::motion
