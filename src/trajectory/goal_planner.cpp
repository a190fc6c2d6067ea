#include "interpolated_motion_driver/trajectory/goal_planner.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/trajectory/goal_start.h"
#include "interpolated_motion_driver/trajectory/goal_validation.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/path_builder.h"
#include "interpolated_motion_driver/trajectory/point_selection.h"
#include "interpolated_motion_driver/trajectory/rest_to_rest.h"

namespace interpolated_motion::trajectory {

namespace {

void check_count(const char* what, std::size_t count, std::size_t joints) {
  if (count == joints) return;
  throw std::invalid_argument(
      fmt::format("plan_goal: {} {} for {} joints; give one per joint", count, what, joints));
}

void check_arguments(const GoalRules& rules, const std::vector<State>& present) {
  const std::size_t joints = rules.joints.size();
  check_count("limits", rules.limits.size(), joints);
  check_count("start tolerances", rules.start_tolerance.size(), joints);
  check_count("lead-in thresholds", rules.lead_in_threshold.size(), joints);
  check_count("present states", present.size(), joints);
}

KnotData given(const Waypoint& point) {
  if (point.velocities.empty()) return KnotData::Position;
  return point.accelerations.empty() ? KnotData::Velocity : KnotData::Acceleration;
}

/// A goal is made late at most so many times, each time by this at least: the way to the first point may need
/// more than the shortest way between two states, where the curve goes on behind it.
constexpr int kMostWays = 40;
constexpr GoalTime kLeastLack{0.02};
/// Of the least time that the way takes: a drive that interpolates by itself goes a little beyond what it is
/// told, so the limit should not be used up.
constexpr double kEasy = 1.2;

/// The paths of one goal whose points are selected and whose start is decided.
class PathMaker {
 public:
  PathMaker(const Goal& goal, const GoalRules& rules, const std::vector<State>& present,
            PointSelection& selection, const GoalStart& start)
      : goal_(goal), rules_(rules), present_(present), selection_(selection), start_(start) {
    knots_.reserve(selection.points.size() + 1);
  }

  GoalTime duration() const { return time_of(selection_.points.back()); }

  /// Gives the way to the first point that was refused the time that it lacks: all points are met so much
  /// later. The way is smoother then than the points ask for, without a step of acceleration at its ends, so
  /// that drives can follow it which interpolate by themselves. False if it is not a matter of time.
  bool meet_later() {
    if (lack_) meet_later_by(std::max(*lack_, kLeastLack));
    return lack_.has_value();
  }

  void meet_later_by(GoalTime late) {
    selection_.late += late;
    selection_.skipped -= late;
  }

  bool names(std::size_t joint) const { return selection_.columns[joint] != kNotNamed; }

  Expected<Path, Refusal> make(std::size_t joint) {
    lack_.reset();
    if (!names(joint)) return resting_path(joint);
    if (auto refusal = check_end(joint)) return *refusal;
    Path path = moving_path(joint);
    if (const auto violation = find_limit_violation(path, rules_.limits[joint]))
      return refuse(joint, *violation);
    return path;
  }

 private:
  GoalTime time_of(std::size_t point) const { return goal_.points[point].time - selection_.skipped; }

  Path resting_path(std::size_t joint) const {
    Polynomial constant;
    constant.coefficients[0] = present_[joint].position;
    return Path({Piece{-start_.lead_in, duration(), constant}});
  }

  std::optional<Refusal> check_end(std::size_t joint) const {
    const std::size_t last = selection_.points.back();
    const Waypoint& point = goal_.points[last];
    if (point.velocities.empty()) return std::nullopt;
    const double velocity = point.velocities[selection_.columns[joint]];
    const JointUnit unit = rules_.limits[joint].unit;
    if (std::abs(velocity) <= rest_velocity(unit)) return std::nullopt;
    return Refusal{
        GoalError::InvalidGoal,
        fmt::format("{}: the last point, points[{}], has a velocity of {:.6g} {}, allowed is {:g} at most: a "
                    "drive cannot stop in no time. Let the trajectory end at rest.",
                    rules_.joints[joint], last, velocity, symbol(unit, Quantity::Velocity),
                    rest_velocity(unit))};
  }

  Knot knot(std::size_t joint, std::size_t index) const {
    Knot result = knot_of_point(joint, index);
    if (index != selection_.points.front()) return result;
    if (result.given == KnotData::Position) keep_own_velocity(joint, result);
    const bool ends_there = selection_.points.size() == 1;  // at rest, whatever is given
    if (selection_.late.count() > 0.0 && (ends_there || result.given == KnotData::Velocity))
      result.given = KnotData::Acceleration;
    return result;
  }

  Knot knot_of_point(std::size_t joint, std::size_t index) const {
    const Waypoint& point = goal_.points[index];
    const std::size_t column = selection_.columns[joint];
    Knot result;
    result.time = time_of(index);
    result.given = given(point);
    result.state.position = point.positions[column] + start_.shift[joint];
    if (result.given != KnotData::Position) result.state.velocity = point.velocities[column];
    if (result.given == KnotData::Acceleration) result.state.acceleration = point.accelerations[column];
    return result;
  }

  /// Through the first point left the path goes as fast as the goal's whole curve does, those points included
  /// that are left out: else what comes behind might ask for more than it does there.
  void keep_own_velocity(std::size_t joint, Knot& first) const {
    const std::size_t index = selection_.points.front();
    if (index == 0 || selection_.points.size() == 1) return;
    const Knot before = knot_of_point(joint, index - 1);
    if (first.time - before.time < kMinimumStep) return;
    first.state.velocity = velocity_between(before, first, knot_of_point(joint, selection_.points[1]));
    first.given = KnotData::Velocity;
  }

  static void bring_to_rest(JointUnit unit, Knot& knot) {
    knot.state.velocity = 0.0;
    if (std::abs(knot.state.acceleration) <= in_unit(unit, kRestAcceleration)) knot.state.acceleration = 0.0;
  }

  void collect_knots(std::size_t joint) {
    knots_.clear();
    if (start_.bridge) {
      knots_.push_back({GoalTime(0.0), present_[joint], KnotData::Acceleration});
    }
    for (const std::size_t index : selection_.points) knots_.push_back(knot(joint, index));
    knots_.front().time = GoalTime(0.0);
    if (!start_.bridge) bring_to_rest(rules_.limits[joint].unit, knots_.front());
    bring_to_rest(rules_.limits[joint].unit, knots_.back());
  }

  Path moving_path(std::size_t joint) {
    collect_knots(joint);
    std::vector<Piece> pieces;
    pieces.reserve(knots_.size());
    if (start_.lead_in.count() > 0.0) {
      Piece piece = rest_to_rest(present_[joint].position, knots_.front().state.position, -start_.lead_in,
                                 start_.lead_in);
      pieces.push_back(piece);
    }
    append_pieces(knots_, pieces);
    return Path(std::move(pieces));
  }

  bool stops_at(std::size_t point) const {
    const std::vector<double>& velocities = goal_.points[point].velocities;
    bool stops = !velocities.empty();
    for (std::size_t joint = 0; stops && joint < selection_.columns.size(); ++joint) {
      const std::size_t column = selection_.columns[joint];
      if (column == kNotNamed) continue;
      stops = std::abs(velocities[column]) <= rest_velocity(rules_.limits[joint].unit);
    }
    return stops;
  }

  bool stops_at_every_point() const {
    const bool has_inner_points = selection_.points.size() + (start_.bridge ? 1 : 0) > 2;
    return has_inner_points && std::all_of(selection_.points.begin(), selection_.points.end(),
                                           [this](std::size_t point) { return stops_at(point); });
  }

  /// At the first point's own time it may be the way there, or the one behind it.
  bool is_on_bridge(std::size_t joint, const LimitViolation& violation) const {
    if (!start_.bridge) return false;
    const std::size_t first = selection_.points.front();
    if (violation.time != time_of(first)) return violation.time < time_of(first);
    const auto least = least_bridge(joint, first);
    return !least || *least > time_of(first);
  }

  Refusal refuse(std::size_t joint, LimitViolation violation) {
    const std::size_t first = selection_.points.front();
    const bool on_bridge = is_on_bridge(joint, violation);
    violation.time += selection_.skipped;
    violation.at_knot = violation.at_knot && !on_bridge;
    Refusal refusal = limit_refusal(rules_.joints[joint], rules_.limits[joint].unit, violation);
    if (stops_at_every_point()) {
      refusal.text +=
          " Every point has velocity 0, so the trajectory stops at each of them and sets out again: leave "
          "the velocities "
          "out, and a smooth path is made through the points, or give those that the motion has there.";
    }
    if (on_bridge) add_bridge(joint, first, refusal.text);
    return refusal;
  }

  /// Where the joint comes from, and what time the way would take.
  void add_bridge(std::size_t joint, std::size_t first, std::string& text) {
    const State& from = present_[joint];
    const JointUnit unit = rules_.limits[joint].unit;
    const std::string start =
        from.velocity == 0.0
            ? fmt::format("rest at the present position {:.6g} {}", from.position, symbol(unit))
            : fmt::format("{:.6g} {} and {:.6g} {}, where the joint will be when the goal can take over",
                          from.position, symbol(unit), from.velocity, symbol(unit, Quantity::Velocity));
    text += fmt::format(" This is on the way from {} to points[{}], for which there are {:.6f} s.", start,
                        first, time_of(first).count());
    const auto least = least_bridge(joint, first);
    if (!least) return;
    text += fmt::format(" It takes {:.2f} s at least.", least->count());
    lack_ = kEasy * *least - time_of(first);
  }

  /// The shortest time, to a tenth more, in which the first point can be reached; nothing if it is not a
  /// matter of time.
  std::optional<GoalTime> least_bridge(std::size_t joint, std::size_t first) const {
    constexpr double kNext = 1.1;
    constexpr GoalTime kLongest{60.0};
    const Knot from{GoalTime(0.0), present_[joint], KnotData::Acceleration};
    Knot to = knot(joint, first);
    for (to.time = std::max(time_of(first), kShortestMotion); to.time <= kLongest; to.time *= kNext) {
      if (!find_limit_violation(build_path({from, to}), rules_.limits[joint])) return to.time;
    }
    return std::nullopt;
  }

  const Goal& goal_;
  const GoalRules& rules_;
  const std::vector<State>& present_;
  PointSelection& selection_;
  const GoalStart& start_;
  std::vector<Knot> knots_;
  std::optional<GoalTime> lack_;
};

std::string late_text(const PointSelection& selection) {
  return fmt::format(
      "The points are met {:.2f} s late: there was too little time to reach points[{}] within the limits.",
      selection.late.count(), selection.points.front());
}

/// The paths of all joints.
Expected<std::vector<Path>, Refusal> make_paths(PathMaker& maker, std::size_t joints) {
  std::vector<Path> paths;
  for (std::size_t joint = 0; joint < joints; ++joint) {
    auto path = maker.make(joint);
    if (!path) return path.error();
    paths.push_back(std::move(path).value());
  }
  return paths;
}

/// Checks the goal's form and picks the points that a path goes through.
Expected<PointSelection, Refusal> select_points(const Goal& goal, const GoalRules& rules, HostTime now,
                                                std::vector<std::string>& warnings) {
  if (auto refusal = validate_goal(goal, rules.joints, rules.allow_partial_joints)) return *refusal;
  if (is_stop_request(goal))
    return Refusal{GoalError::InvalidGoal, "The goal has no points: it is a request to stop."};
  if (auto refusal = validate_stamp(goal, rules.max_start_ahead, now)) return *refusal;
  const auto columns = joint_columns(goal.joint_names, rules.joints, rules.allow_partial_joints);
  if (!columns) return columns.error();
  const auto future = drop_past_points(goal, now, rules.keep_last_point);
  if (!future) return future.error();
  if (!future.value().warning.empty()) warnings.push_back(future.value().warning);
  auto points = merge_near_points(goal, rules, future.value().first);
  if (!points) return points.error();
  return PointSelection{columns.value(), std::move(points).value(), future.value().skipped,
                        future.value().late};
}

void warn_of_unused_accelerations(const Goal& goal, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < goal.points.size(); ++i) {
    if (goal.points[i].accelerations.empty() || !goal.points[i].velocities.empty()) continue;
    warnings.push_back(
        fmt::format("points[{}] has accelerations but no velocities; accelerations are used together with "
                    "velocities only.",
                    i));
    return;
  }
}

}  // namespace

Expected<GoalPlan, Refusal> plan_goal(const Goal& goal, const GoalRules& rules,
                                      const std::vector<State>& present, HostTime now) {
  check_arguments(rules, present);
  GoalPlan plan;
  auto selected = select_points(goal, rules, now, plan.warnings);
  if (!selected) return selected.error();
  PointSelection selection = std::move(selected).value();
  auto start = plan_start(goal, rules, present, selection);
  if (!start) return start.error();
  if (start.value().lead_in.count() > 0.0) start.value().lead_in += rules.least_late;
  if (!start.value().warning.empty()) plan.warnings.push_back(start.value().warning);
  warn_of_unused_accelerations(goal, plan.warnings);

  PathMaker maker(goal, rules, present, selection, start.value());
  plan.bridge = start.value().bridge;
  if (plan.bridge && rules.least_late.count() > 0.0) maker.meet_later_by(rules.least_late);
  auto paths = make_paths(maker, rules.joints.size());
  for (int ways = 1; !paths && rules.join_late && ways < kMostWays && maker.meet_later(); ++ways)
    paths = make_paths(maker, rules.joints.size());
  if (!paths) return paths.error();
  plan.paths = std::move(paths).value();
  for (std::size_t joint = 0; joint < rules.joints.size(); ++joint) plan.named.push_back(maker.names(joint));
  if (selection.late.count() > 0.0) plan.warnings.push_back(late_text(selection));
  plan.lead_in = start.value().lead_in;
  plan.duration = maker.duration();
  plan.skipped = selection.skipped;
  return plan;
}

}  // namespace interpolated_motion::trajectory
