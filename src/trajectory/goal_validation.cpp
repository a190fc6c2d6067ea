#include "interpolated_motion_driver/trajectory/goal_validation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpolated_motion_driver/units/time_span.h"

namespace interpolated_motion::trajectory {

namespace {

constexpr const char* kSizeMismatch =
    "Size mismatch in trajectory point position, velocity or acceleration data.";
constexpr const char* kNotIncreasing =
    "Trajectory message contains waypoints that are not strictly increasing in time.";

using Verdict = std::optional<Refusal>;

std::string list(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

Refusal invalid_joints(const std::string& text) { return {GoalError::InvalidJoints, text}; }

Refusal invalid_goal(const std::string& text) { return {GoalError::InvalidGoal, text}; }

/// Gives the joint called `name` the column `column`.
Verdict assign(const std::string& name, std::size_t column, const std::vector<std::string>& joints,
               std::vector<std::size_t>& columns) {
  const auto found = std::find(joints.begin(), joints.end(), name);
  if (found == joints.end()) {
    return invalid_joints(fmt::format("Joint '{}' is not known here. Known joints: {}.", name, list(joints)));
  }
  std::size_t& place = columns[static_cast<std::size_t>(found - joints.begin())];
  if (place != kNotNamed) {
    return invalid_joints(fmt::format("Joint '{}' is named twice in the goal. Name every joint once.", name));
  }
  place = column;
  return std::nullopt;
}

Verdict check_size(const std::vector<double>& values, const char* what, std::size_t point, std::size_t joints,
                   bool may_be_empty) {
  if (values.size() == joints || (may_be_empty && values.empty())) return std::nullopt;
  return invalid_goal(
      fmt::format("{} points[{}] has {} {} for {} joint names. Give {}one for every joint name.",
                  kSizeMismatch, point, values.size(), what, joints, may_be_empty ? "none or " : ""));
}

bool acceptable(double value) { return std::abs(value) <= kLargestValue; }

Verdict check_values(const std::vector<double>& values, const char* what, std::size_t point,
                     const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (acceptable(values[i])) continue;
    return invalid_goal(
        fmt::format("points[{}]: {} of joint '{}' is {}, allowed are finite numbers up to +-{:g}. "
                    "Correct the program that made the goal.",
                    point, what, names[i], values[i], kLargestValue));
  }
  return std::nullopt;
}

Verdict check_point(const Waypoint& point, std::size_t index, const std::vector<std::string>& names) {
  const std::size_t joints = names.size();
  if (auto v = check_size(point.positions, "positions", index, joints, false)) return v;
  if (auto v = check_size(point.velocities, "velocities", index, joints, true)) return v;
  if (auto v = check_size(point.accelerations, "accelerations", index, joints, true)) return v;
  if (auto v = check_size(point.efforts, "efforts", index, joints, true)) return v;
  if (auto v = check_values(point.positions, "the position", index, names)) return v;
  if (auto v = check_values(point.velocities, "the velocity", index, names)) return v;
  if (auto v = check_values(point.accelerations, "the acceleration", index, names)) return v;
  return check_values(point.efforts, "the effort", index, names);
}

Verdict check_time(const std::vector<Waypoint>& points, std::size_t index) {
  const double time = points[index].time.count();
  if (!(time >= 0.0 && time <= kLatestTime.count())) {
    return invalid_goal(fmt::format("points[{}]: time_from_start is {} s, allowed is 0 s to {:.0f} s.", index,
                                    time, kLatestTime.count()));
  }
  if (index == 0 || points[index - 1].time < points[index].time) return std::nullopt;
  return invalid_goal(
      fmt::format("{} points[{}] is at {:.9f} s, points[{}] at {:.9f} s. Give every point a later time "
                  "than the one before.",
                  kNotIncreasing, index - 1, points[index - 1].time.count(), index, time));
}

Verdict check_points(const Goal& goal) {
  for (std::size_t i = 0; i < goal.points.size(); ++i) {
    if (auto v = check_time(goal.points, i)) return v;
    if (auto v = check_point(goal.points[i], i, goal.joint_names)) return v;
  }
  return std::nullopt;
}

Verdict check_tolerances(const std::vector<JointTolerance>& tolerances, const char* what,
                         const std::vector<std::string>& joints) {
  for (const JointTolerance& tolerance : tolerances) {
    if (std::find(joints.begin(), joints.end(), tolerance.joint) == joints.end()) {
      return invalid_joints(fmt::format("{} names joint '{}', which is not known here. Known joints: {}.",
                                        what, tolerance.joint, list(joints)));
    }
    for (const double value : {tolerance.position, tolerance.velocity, tolerance.acceleration}) {
      if (value <= kLargestTolerance && std::isfinite(value)) continue;
      return invalid_goal(fmt::format(
          "{} of joint '{}' is {}, allowed are finite numbers up to {:g}: positive to set it, 0 to "
          "keep the default, negative to erase it.",
          what, tolerance.joint, value, kLargestTolerance));
    }
  }
  return std::nullopt;
}

Verdict check_goal_time(double tolerance) {
  if (tolerance <= kLargestTolerance && std::isfinite(tolerance)) return std::nullopt;
  return invalid_goal(fmt::format(
      "goal_time_tolerance is {} s, allowed are finite numbers up to {:g} s: positive to set it, 0 "
      "to keep the default, negative to erase it.",
      tolerance, kLargestTolerance));
}

Verdict check_complete(const std::vector<std::size_t>& columns, const std::vector<std::string>& joints) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (columns[i] != kNotNamed) continue;
    return invalid_joints(
        fmt::format("Joint '{}' is missing in the goal. Name all of {}, or set the parameter "
                    "allow_partial_joints_goal.",
                    joints[i], list(joints)));
  }
  return std::nullopt;
}

}  // namespace

Expected<std::vector<std::size_t>, Refusal> joint_columns(const std::vector<std::string>& names,
                                                          const std::vector<std::string>& joints,
                                                          bool allow_partial) {
  if (names.empty()) return invalid_joints(fmt::format("The goal names no joints. Name {}.", list(joints)));
  std::vector<std::size_t> columns(joints.size(), kNotNamed);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (auto refusal = assign(names[i], i, joints, columns)) return *refusal;
  }
  if (allow_partial) return columns;
  if (auto refusal = check_complete(columns, joints)) return *refusal;
  return columns;
}

bool is_stop_request(const Goal& goal) { return goal.points.empty(); }

std::optional<Refusal> validate_goal(const Goal& goal, const std::vector<std::string>& joints,
                                     bool allow_partial) {
  const auto columns = joint_columns(goal.joint_names, joints, allow_partial);
  if (!columns) return columns.error();
  if (goal.points.size() > kMostPoints) {
    return invalid_goal(fmt::format(
        "The goal has {} points, allowed are at most {}. Send it in pieces, or with points further "
        "apart: between them the path is smooth.",
        goal.points.size(), kMostPoints));
  }
  if (auto v = check_points(goal)) return v;
  if (auto v = check_tolerances(goal.path_tolerance, "path_tolerance", joints)) return v;
  if (auto v = check_tolerances(goal.goal_tolerance, "goal_tolerance", joints)) return v;
  return check_goal_time(goal.goal_time_tolerance);
}

std::optional<Refusal> validate_stamp(const Goal& goal, GoalTime max_ahead, HostTime now) {
  if (!goal.start) return std::nullopt;
  const double ahead = seconds(span(now, *goal.start));
  if (ahead <= max_ahead.count()) return std::nullopt;
  return invalid_goal(
      fmt::format("The stamp of the goal is {:.10g} s ahead, allowed is at most {:g} s ahead (parameter "
                  "max_start_ahead). Send it later, or with stamp 0 to start at once; if the stamp was to be "
                  "about now, synchronise the clocks.",
                  ahead, max_ahead.count()));
}

}  // namespace interpolated_motion::trajectory
