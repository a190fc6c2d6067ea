#include "interpolated_motion_driver/motion/begin_planning.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::motion {

namespace {

Planning::AxisPart part_of(const axis::Axis& axis, axis::TailEncoderPtr encoder) {
  return {axis.bus(), axis.record_bus_time(), axis.bus_watch(), std::move(encoder)};
}

PlanningPtr planning_of(GoalPtr goal, const trajectory::GoalRules& rules, const trajectory::Speed& speed,
                        HostTime now) {
  auto planning = std::make_shared<Planning>();
  planning->goal = std::move(goal);
  planning->rules = rules;
  planning->speed = speed;
  planning->now = now;
  return planning;
}

void begin_from_rest(Planning& planning, const Axes& axes) {
  const GoalTime wait = wait_after_signal(axes);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double rest = planning.present[i].position;
    planning.axes.push_back(part_of(*axes[i], axes[i]->encoder_at_rest(rest, wait)));
  }
}

/// Nothing moves from goal time `from` on.
bool rests(const std::vector<trajectory::Path>& paths, GoalTime from) {
  return std::all_of(paths.begin(), paths.end(), [from](const trajectory::Path& path) {
    return path.empty() || path.end_time() <= from || trajectory::rest_begin(path) <= from;
  });
}

void begin_behind(Planning& planning, const Axes& axes, const Course& course, GoalTime join, GoalTime linger,
                  HostTime now) {
  planning.entry = Planning::Entry::Join;
  planning.joining.join = join;
  planning.joining.present = axes.front()->playback(now);
  planning.joining.kept = oldest_playback(axes, now) - kKept;
  planning.joining.linger = linger;
  planning.joining.course = course.timed();
  for (const axis::Axis* axis : axes)
    planning.axes.push_back(part_of(*axis, axis->encoder_behind(axis::Pace::Goal)));
}

}  // namespace

PlanningPtr planning_from_rest(const Axes& axes, GoalPtr goal, const trajectory::GoalRules& rules,
                               const trajectory::Speed& speed, const std::vector<trajectory::State>& rest,
                               HostTime now) {
  PlanningPtr planning = planning_of(std::move(goal), rules, speed, now);
  planning->present = rest;
  begin_from_rest(*planning, axes);
  return planning;
}

// Where nothing moves any more, whatever the speed was is over: from there on it may be any other at once.
PlanningPtr planning_to_join(const Axes& axes, GoalPtr goal, const trajectory::GoalRules& rules,
                             const trajectory::Speed& speed, const Course& course, GoalTime until,
                             GoalTime linger, HostTime now) {
  const HostTime earliest = now + host_duration((until - axes.front()->playback(now)).count());
  const HostTime when = goal->start ? std::max(earliest, *goal->start) : earliest;
  const GoalTime join = until + GoalTime{seconds(when - earliest)};
  PlanningPtr planning = planning_of(std::move(goal), rules, speed, when);
  begin_behind(*planning, axes, course, join, linger, now);
  TimedPaths& former = planning->joining.course;
  if (rests(former.executed, join)) {
    former.nominal = former.executed;
    former.law = trajectory::TimeLaw(std::min(speed.rate, 1.0), join, join);
  }
  const GoalTime nominal = former.law.at(join).nominal;
  for (const trajectory::Path& path : former.nominal) planning->present.push_back(path.sample(nominal));
  return planning;
}

PlanningPtr planning_of_speed(const Axes& axes, const trajectory::GoalRules& rules,
                              const trajectory::Speed& speed, const Course& course, GoalTime until,
                              GoalTime end, GoalTime linger, HostTime now) {
  PlanningPtr planning = planning_of(nullptr, rules, speed, now);
  planning->motion.end = end;
  begin_behind(*planning, axes, course, until, linger, now);
  return planning;
}

PlanningPtr planning_to_resume(const Axes& axes, const trajectory::GoalRules& rules,
                               const trajectory::Speed& speed, const ActiveGoal& paused, HostTime now) {
  PlanningPtr planning = planning_of(nullptr, rules, speed, now);
  const trajectory::TimeLaw& law = paused.course.law;
  planning->present = rest_states(axes);
  planning->motion = {paused.course.nominal, law.at(law.steady_from()).nominal, paused.end,
                      paused.zero - paused.lead_in};
  begin_from_rest(*planning, axes);
  return planning;
}

double first_position(const trajectory::Goal& goal, const trajectory::GoalRules& rules, std::size_t joint,
                      double otherwise) {
  const auto name = std::find(goal.joint_names.begin(), goal.joint_names.end(), rules.joints[joint]);
  const auto number = static_cast<std::size_t>(name - goal.joint_names.begin());
  const std::vector<double>& positions = goal.points.front().positions;
  if (number >= positions.size() || !std::isfinite(positions[number])) return otherwise;
  const trajectory::JointLimits& limits = rules.limits[joint];
  if (limits.continuous) return positions[number];
  return std::clamp(positions[number], limits.min_position, limits.max_position);
}

}  // namespace interpolated_motion::motion
