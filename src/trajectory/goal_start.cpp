#include "interpolated_motion_driver/trajectory/goal_start.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "interpolated_motion_driver/trajectory/goal_validation.h"
#include "interpolated_motion_driver/trajectory/point_selection.h"
#include "interpolated_motion_driver/trajectory/rest_to_rest.h"

namespace interpolated_motion::trajectory {

namespace {

constexpr double kTurn = 6.283185307179586476925;

/// Turns (a whole number) that bring a point nearest to a joint that is `distance` rad beyond it. At half a
/// turn either way is as near; then the fewer turns: the joint goes the way that the numbers of the goal say.
double nearest_turns(double distance) {
  const double fewer = std::trunc(distance / kTurn);
  const double rest = distance - fewer * kTurn;
  return std::abs(rest) <= 0.5 * kTurn + kHalfTurnTolerance ? fewer : fewer + std::copysign(1.0, rest);
}

/// The first point against the present positions.
class StartPoint {
 public:
  StartPoint(const Waypoint& point, const std::vector<std::size_t>& columns, const GoalRules& rules,
             const std::vector<State>& present)
      : point_(point), columns_(columns), rules_(rules), present_(present) {}

  std::vector<double> shifts() const {
    std::vector<double> result(columns_.size(), 0.0);
    for (std::size_t joint = 0; joint < columns_.size(); ++joint) {
      if (!named(joint) || !rules_.limits[joint].continuous) continue;
      const double distance = present_[joint].position - point_.positions[columns_[joint]];
      result[joint] = kTurn * nearest_turns(distance);
    }
    return result;
  }

  std::optional<Refusal> check_tolerance(const std::vector<double>& shift) const {
    for (std::size_t joint = 0; joint < columns_.size(); ++joint) {
      if (!named(joint) || std::abs(deviation(joint, shift)) <= rules_.start_tolerance[joint]) continue;
      return Refusal{
          GoalError::InvalidGoal,
          fmt::format(
              "{0}: the trajectory starts at {1:.6g} {4}, but the joint is at {2:.6g} {4}; allowed is a "
              "difference of {3:.6g} {4} (start tolerance). Plan from the present position, or give the "
              "first "
              "point a time_from_start that is enough to get there.",
              rules_.joints[joint], point_.positions[columns_[joint]] + shift[joint],
              present_[joint].position, rules_.start_tolerance[joint], symbol(unit_of(joint)))};
    }
    return std::nullopt;
  }

  /// Index of a joint that the point wants to move already.
  std::optional<std::size_t> moving_joint() const {
    if (point_.velocities.empty()) return std::nullopt;
    for (std::size_t joint = 0; joint < columns_.size(); ++joint) {
      if (named(joint) && std::abs(point_.velocities[columns_[joint]]) > rest_velocity(unit_of(joint)))
        return joint;
    }
    return std::nullopt;
  }

  std::string moving_warning(std::size_t joint, std::size_t index) const {
    return fmt::format(
        "{}: the trajectory starts with a velocity of {:.6g} {} at points[{}], but the joint is at rest "
        "(a velocity up to {:g} passes for rest). The present state takes the place of that point.",
        rules_.joints[joint], point_.velocities[columns_[joint]], symbol(unit_of(joint), Quantity::Velocity),
        index, rest_velocity(unit_of(joint)));
  }

  /// Length of the common lead-in, 0 if no joint needs one.
  GoalTime lead_in(const std::vector<double>& shift) const {
    bool needed = false;
    GoalTime longest = kShortestMotion;
    for (std::size_t joint = 0; joint < columns_.size(); ++joint) {
      if (!named(joint)) continue;
      const double distance = deviation(joint, shift);
      needed = needed || std::abs(distance) > rules_.lead_in_threshold[joint];
      longest = std::max(longest, rest_to_rest_duration(distance, rules_.limits[joint], kLeadInPart));
    }
    return needed ? GoalTime(std::ceil(longest.count() * 1000.0) / 1000.0) : GoalTime(0.0);
  }

 private:
  JointUnit unit_of(std::size_t joint) const { return rules_.limits[joint].unit; }
  bool named(std::size_t joint) const { return columns_[joint] != kNotNamed; }
  double deviation(std::size_t joint, const std::vector<double>& shift) const {
    return point_.positions[columns_[joint]] + shift[joint] - present_[joint].position;
  }

  const Waypoint& point_;
  const std::vector<std::size_t>& columns_;
  const GoalRules& rules_;
  const std::vector<State>& present_;
};

constexpr const char* kBrakedWarning =
    "The joints were braking when the goal was sent: its first point, at time 0, is left out, and the way "
    "begins where they have come to rest.";

/// Whether any joint is on its way.
bool in_motion(const std::vector<State>& present) {
  return std::any_of(present.begin(), present.end(),
                     [](const State& state) { return state.velocity != 0.0 || state.acceleration != 0.0; });
}

}  // namespace

Expected<GoalStart, Refusal> plan_start(const Goal& goal, const GoalRules& rules,
                                        const std::vector<State>& present, PointSelection& selection) {
  const std::size_t first = selection.points.front();
  const StartPoint point(goal.points[first], selection.columns, rules, present);
  GoalStart start;
  start.shift = point.shifts();
  start.bridge = goal.points[first].time - selection.skipped >= kMinimumStep;
  if (start.bridge) return start;
  if (selection.points.size() == 1) {
    return all_points_past(
        goal.points.size(), GoalTime(0.0),
        fmt::format("A goal needs a point {:g} s or more after its start.", kMinimumStep.count()));
  }
  if (in_motion(present)) {
    start.bridge = true;
    selection.points.erase(selection.points.begin());
    return start;
  }
  const auto far = point.check_tolerance(start.shift);
  if (far && !rules.sent_in_motion) return *far;
  const auto moving = point.moving_joint();
  if (far || moving) {
    start.bridge = true;
    start.warning = far ? kBrakedWarning : point.moving_warning(*moving, first);
    selection.points.erase(selection.points.begin());
    return start;
  }
  start.lead_in = point.lead_in(start.shift);
  return start;
}

}  // namespace interpolated_motion::trajectory
