#include "interpolated_motion_driver/trajectory/tolerances.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace interpolated_motion::trajectory {

namespace {

void check_parameter(const std::string& parameter, double value) {
  if (std::isfinite(value) && value >= 0.0) return;
  throw std::invalid_argument(fmt::format(
      "parameter {} is {}, but must be a finite number >= 0 (0 switches the check off)", parameter, value));
}

void override_with(double& tolerance, double asked) {
  if (asked > 0.0) tolerance = asked;
  if (asked < 0.0) tolerance = 0.0;
}

void apply(const std::vector<JointTolerance>& asked, const std::vector<std::string>& joints,
           std::vector<StateTolerance>& tolerances) {
  for (const JointTolerance& entry : asked) {
    const auto joint = std::find(joints.begin(), joints.end(), entry.joint);
    if (joint == joints.end()) continue;
    StateTolerance& tolerance = tolerances[static_cast<std::size_t>(joint - joints.begin())];
    override_with(tolerance.position, entry.position);
    override_with(tolerance.velocity, entry.velocity);
    override_with(tolerance.acceleration, entry.acceleration);
  }
}

bool violates(double error, double tolerance) { return tolerance > 0.0 && !(std::abs(error) <= tolerance); }

/// Who has violated which tolerance.
struct Violator {
  const std::string& joint;
  JointUnit unit;
  const ToleranceViolation& violation;
};

Refusal violated(GoalError code, const char* kind, const Violator& by, const char* advice) {
  const ToleranceViolation& v = by.violation;
  return {code, fmt::format(
                    "{0} {1} error {2:f}. The {3} of {0} is off by {4:.6g} {6}, allowed is {5:.6g} {6}. {7}",
                    by.joint, kind, v.position_error, name(v.quantity), v.error, v.tolerance,
                    symbol(by.unit, v.quantity), advice)};
}

}  // namespace

Tolerances default_tolerances(const std::vector<double>& trajectory, const std::vector<double>& goal,
                              const std::vector<double>& stopped_velocity, double goal_time) {
  if (trajectory.size() != goal.size() || stopped_velocity.size() != goal.size()) {
    throw std::invalid_argument(
        fmt::format("tolerances: {} of constraints/<joint>/trajectory, {} of constraints/<joint>/goal and {} "
                    "of constraints/stopped_velocity_tolerance; each joint needs one of each",
                    trajectory.size(), goal.size(), stopped_velocity.size()));
  }
  check_parameter("constraints/goal_time", goal_time);
  Tolerances result;
  result.goal_time = GoalTime(goal_time);
  for (std::size_t i = 0; i < goal.size(); ++i) {
    check_parameter(fmt::format("constraints/<joint {}>/trajectory", i), trajectory[i]);
    check_parameter(fmt::format("constraints/<joint {}>/goal", i), goal[i]);
    check_parameter("constraints/stopped_velocity_tolerance", stopped_velocity[i]);
    result.path.push_back({trajectory[i], 0.0, 0.0});
    result.goal.push_back({goal[i], stopped_velocity[i], 0.0});
  }
  return result;
}

Tolerances merge_tolerances(const Tolerances& defaults, const std::vector<std::string>& joints,
                            const Goal& goal) {
  Tolerances result = defaults;
  apply(goal.path_tolerance, joints, result.path);
  apply(goal.goal_tolerance, joints, result.goal);
  double goal_time = defaults.goal_time.count();
  override_with(goal_time, goal.goal_time_tolerance);
  result.goal_time = GoalTime(goal_time);
  return result;
}

std::optional<ToleranceViolation> find_tolerance_violation(const std::vector<StateTolerance>& tolerances,
                                                           const std::vector<State>& desired,
                                                           const std::vector<State>& actual) {
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    const double position = desired[i].position - actual[i].position;
    const double velocity = desired[i].velocity - actual[i].velocity;
    const double acceleration = desired[i].acceleration - actual[i].acceleration;
    const StateTolerance& tolerance = tolerances[i];
    if (violates(position, tolerance.position)) {
      return ToleranceViolation{i, Quantity::Position, position, tolerance.position, position};
    }
    if (violates(velocity, tolerance.velocity)) {
      return ToleranceViolation{i, Quantity::Velocity, velocity, tolerance.velocity, position};
    }
    if (violates(acceleration, tolerance.acceleration)) {
      return ToleranceViolation{i, Quantity::Acceleration, acceleration, tolerance.acceleration, position};
    }
  }
  return std::nullopt;
}

Refusal path_tolerance_violated(const std::string& joint, JointUnit unit,
                                const ToleranceViolation& violation) {
  return violated(GoalError::PathToleranceViolated, "path", {joint, unit, violation},
                  "Slow the trajectory down, or widen its path_tolerance or the parameter "
                  "constraints/<joint>/trajectory.");
}

Refusal goal_tolerance_violated(const std::string& joint, JointUnit unit,
                                const ToleranceViolation& violation) {
  return violated(
      GoalError::GoalToleranceViolated, "goal", {joint, unit, violation},
      "Allow more time to settle (goal_time_tolerance), or widen the goal_tolerance or the parameters "
      "constraints/<joint>/goal and constraints/stopped_velocity_tolerance.");
}

}  // namespace interpolated_motion::trajectory
