#include "interpolated_motion_driver/trajectory/point_selection.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/rest_to_rest.h"
#include "interpolated_motion_driver/units/time_span.h"

namespace interpolated_motion::trajectory {

namespace {

/// Times come in whole nanoseconds; their differences are rounded.
constexpr GoalTime kHalfNanosecond{0.5e-9};

/// Of the joints of a goal.
std::vector<JointUnit> units_of(const Goal& goal, const GoalRules& rules) {
  std::vector<JointUnit> units;
  for (const std::string& name : goal.joint_names) {
    const auto found = std::find(rules.joints.begin(), rules.joints.end(), name);
    units.push_back(found == rules.joints.end()
                        ? JointUnit::Radian
                        : rules.limits[static_cast<std::size_t>(found - rules.joints.begin())].unit);
  }
  return units;
}

/// Index of the joint that moves farthest between two points, for its unit.
std::size_t farthest_joint(const Waypoint& a, const Waypoint& b, const std::vector<JointUnit>& units) {
  const auto move = [&](std::size_t joint) {
    return std::abs(b.positions[joint] - a.positions[joint]) / in_unit(units[joint], kMergeDistance);
  };
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < a.positions.size(); ++i) {
    if (move(i) > move(farthest)) farthest = i;
  }
  return farthest;
}

std::optional<Refusal> check_merge(const Goal& goal, const GoalRules& rules, std::size_t earlier,
                                   std::size_t later) {
  const Waypoint& a = goal.points[earlier];
  const Waypoint& b = goal.points[later];
  const std::vector<JointUnit> units = units_of(goal, rules);
  const std::size_t joint = farthest_joint(a, b, units);
  const double move = b.positions[joint] - a.positions[joint];
  const double allowed = in_unit(units[joint], kMergeDistance);
  if (std::abs(move) <= allowed) return std::nullopt;
  return Refusal{
      GoalError::InvalidGoal,
      fmt::format(
          "points[{0}] and points[{1}] are {2:.3g} s apart and move joint '{3}' by {4:.3g} {7}; the shortest "
          "step is {5:g} s, below it the joint may not move by more than {6:g} {7}. Leave one of the points "
          "out, or give them more time.",
          earlier, later, (b.time - a.time).count(), goal.joint_names[joint], move, kMinimumStep.count(),
          allowed, symbol(units[joint]))};
}

std::string dropped_warning(const Goal& goal, const FuturePoints& kept) {
  return fmt::format(
      "Dropping first {} trajectory point(s) out of {}, as they occur before the current time.\nFirst valid "
      "point will be reached in {:.3f}s. The stamp of the goal is {:.6f} s in the past; the motion "
      "goes from where the joints are to that point.",
      kept.first, goal.points.size(), (goal.points[kept.first].time - kept.skipped).count(),
      (kept.skipped + kept.late).count());
}

void keep_last_point(const Goal& goal, FuturePoints& kept) {
  kept.first = goal.points.size() - 1;
  kept.late = kept.skipped + kShortestMotion - goal.points.back().time;
  kept.skipped -= kept.late;
}

}  // namespace

Refusal all_points_past(std::size_t count, GoalTime late, const std::string& sentence) {
  return {GoalError::InvalidGoal,
          fmt::format(
              "Dropping all {} trajectory point(s), as they occur before the current time.\nLast point is "
              "{:.6f}s in the past. {}",
              count, late.count(), sentence)};
}

Expected<FuturePoints, Refusal> drop_past_points(const Goal& goal, HostTime now, bool keep_last) {
  FuturePoints kept;
  if (!goal.start || *goal.start >= now) return kept;
  kept.skipped = GoalTime(seconds(span(*goal.start, now)));
  const GoalTime ahead = keep_last ? kMinimumStep : GoalTime{0.0};
  const auto in_past = [&](const Waypoint& point) { return point.time - kept.skipped <= ahead; };
  const auto first = std::partition_point(goal.points.begin(), goal.points.end(), in_past);
  if (first == goal.points.end()) {
    if (!keep_last) {
      return all_points_past(goal.points.size(), kept.skipped - goal.points.back().time,
                             "Send the goal earlier, or with stamp 0 to start at once; if it was sent in "
                             "time, synchronise the clocks.");
    }
    keep_last_point(goal, kept);
  } else {
    kept.first = static_cast<std::size_t>(first - goal.points.begin());
  }
  if (kept.first > 0) kept.warning = dropped_warning(goal, kept);
  return kept;
}

Expected<std::vector<std::size_t>, Refusal> merge_near_points(const Goal& goal, const GoalRules& rules,
                                                              std::size_t first) {
  const std::size_t last = goal.points.size() - 1;
  std::vector<std::size_t> kept{first};
  kept.reserve(goal.points.size() - first);
  for (std::size_t i = first + 1; i <= last; ++i) {
    if (goal.points[i].time - goal.points[kept.back()].time > kMinimumStep - kHalfNanosecond) {
      kept.push_back(i);
      continue;
    }
    if (auto refusal = check_merge(goal, rules, kept.back(), i)) return *refusal;
    if (i == last) kept.back() = last;
  }
  return kept;
}

}  // namespace interpolated_motion::trajectory
