#include "interpolated_motion_driver/motion/setpoint_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/trajectory/goal_validation.h"
#include "interpolated_motion_driver/units/time_span.h"

namespace interpolated_motion::motion {

namespace {

/// Setpoints further apart tell nothing about a velocity: the arm is braking in between.
constexpr double kPause = 0.25;  // s

Refusal refuse(std::string text) { return {GoalError::InvalidGoal, std::move(text)}; }

/// `values` of the joints of the setpoint: positions or velocities, as `what` says.
std::optional<Refusal> check_values(const Setpoint& setpoint, const char* what,
                                    const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) <= trajectory::kLargestValue) continue;
    return refuse(
        fmt::format("The {} of joint \"{}\" in the setpoint is {}, allowed are finite numbers up to +-{:g}.",
                    what, setpoint.joint_names[i], values[i], trajectory::kLargestValue));
  }
  return std::nullopt;
}

std::size_t column_of(const Setpoint& setpoint, const std::string& joint) {
  const auto& names = setpoint.joint_names;
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), joint) - names.begin());
}

}  // namespace

SetpointPath::SetpointPath(trajectory::GoalRules rules, const StreamParameters& parameters)
    : rules_(std::move(rules)), parameters_(parameters) {}

void SetpointPath::begin(HostTime origin, GoalTime lead) {
  delay_ = parameters_.delay + lead;
  origin_ = origin;
  source_.clear();
  newest_.reset();
  known_ = 0;
  knots_.assign(rules_.joints.size(), {});
}

Expected<std::vector<trajectory::Path>, Refusal> SetpointPath::way_to(
    const Setpoint& setpoint, GoalTime start, const std::vector<trajectory::State>& from,
    const DemandChecks& demands) const {
  std::vector<trajectory::Path> paths;
  for (std::size_t i = 0; i < rules_.joints.size(); ++i) {
    const trajectory::StreamRules rules{rules_.limits[i], parameters_.ride_through, parameters_.catch_up,
                                        demands.empty() ? trajectory::DemandCheck{} : demands[i]};
    const auto aim = target(setpoint, i, column_of(setpoint, rules_.joints[i]));
    const auto on = trajectory::stream_path(from[i], start, aim, rules);
    if (!on) {
      Refusal refusal = trajectory::limit_refusal(rules_.joints[i], rules_.limits[i].unit, on.error());
      refusal.text = fmt::format("The setpoint cannot be reached within {:.2f} s: {}",
                                 parameters_.catch_up.count(), refusal.text);
      return refusal;
    }
    paths.push_back(trajectory::with_rest(on.value(), parameters_.linger));
  }
  return paths;
}

void SetpointPath::take(const Setpoint& setpoint) {
  newest_ = setpoint.time;
  source_ = setpoint.source;
}

void SetpointPath::note(const Setpoint& setpoint) {
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    std::copy_backward(knots_[i].begin(), knots_[i].end() - 1, knots_[i].end());
    knots_[i][0] = {seconds(setpoint.time - origin_),
                    setpoint.positions[column_of(setpoint, rules_.joints[i])]};
  }
  known_ = std::min(known_ + 1, std::tuple_size<Knots>::value);
}

std::optional<Refusal> SetpointPath::check(const Setpoint& setpoint, HostTime now) const {
  if (newest_ && setpoint.source != source_) {
    return refuse(
        fmt::format("\"{}\" sends setpoints while the stream of \"{}\" is under way. End that first.",
                    setpoint.source, source_));
  }
  if (auto refusal = check_joints(setpoint)) return refusal;
  return check_time(setpoint, now);
}

std::optional<Refusal> SetpointPath::check_joints(const Setpoint& setpoint) const {
  const std::size_t joints = rules_.joints.size();
  for (const std::string& joint : rules_.joints) {
    if (column_of(setpoint, joint) == setpoint.joint_names.size())
      return Refusal{
          GoalError::InvalidJoints,
          fmt::format("The setpoint leaves out joint \"{}\": every setpoint names all joints.", joint)};
  }
  if (setpoint.joint_names.size() != joints)
    return Refusal{GoalError::InvalidJoints, fmt::format("The setpoint names {} joints, the group has {}.",
                                                         setpoint.joint_names.size(), joints)};
  const bool has_velocities = !setpoint.velocities.empty();
  if (setpoint.positions.size() != joints || (has_velocities && setpoint.velocities.size() != joints)) {
    return refuse(fmt::format("The setpoint has {} positions and {} velocities for {} joints.",
                              setpoint.positions.size(), setpoint.velocities.size(), joints));
  }
  if (auto refusal = check_values(setpoint, "position", setpoint.positions)) return refusal;
  return check_values(setpoint, "velocity", setpoint.velocities);
}

std::optional<Refusal> SetpointPath::check_time(const Setpoint& setpoint, HostTime now) const {
  if (newest_ && setpoint.time <= *newest_) {
    return refuse(fmt::format("The setpoint is out of order: it is {:.3f} s older than the one before.",
                              seconds(span(setpoint.time, *newest_))));
  }
  const double age = seconds(span(setpoint.time, now));
  if (age > parameters_.max_age.count()) {
    return refuse(fmt::format("The setpoint is of the past: {:.3f} s old, at most {:.3f} s are allowed.", age,
                              parameters_.max_age.count()));
  }
  if (-age <= parameters_.max_ahead.count()) return std::nullopt;
  return refuse(fmt::format("The setpoint is too far ahead: {:.3f} s, at most {:.3f} s are allowed.", -age,
                            parameters_.max_ahead.count()));
}

trajectory::StreamTarget SetpointPath::target(const Setpoint& setpoint, std::size_t joint,
                                              std::size_t column) const {
  const double position = setpoint.positions[column];
  const double velocity = setpoint.velocities.empty()
                              ? estimated_velocity(joint, seconds(setpoint.time - origin_), position)
                              : setpoint.velocities[column];
  return {goal_time(setpoint.time) + delay_, position, velocity};
}

/// Slope at the newest of the parabola through the last three setpoints; with two, of the line; with one, or
/// after a pause, 0. Never more than the joint can do, nor more than it can brake before a limit of position.
double SetpointPath::estimated_velocity(std::size_t joint, double time, double position) const {
  const Knots& knots = knots_[joint];
  if (known_ == 0 || time - knots[0].time > kPause) return 0.0;
  const double slope = (position - knots[0].position) / (time - knots[0].time);
  double velocity = slope;
  if (known_ >= 2 && knots[0].time - knots[1].time <= kPause) {
    const double before = (knots[0].position - knots[1].position) / (knots[0].time - knots[1].time);
    velocity += (slope - before) / (time - knots[1].time) * (time - knots[0].time);
  }
  const trajectory::JointLimits& limits = rules_.limits[joint];
  const auto most = [&limits](double room) {
    return std::min(limits.max_velocity, std::sqrt(2.0 * limits.max_acceleration * std::max(room, 0.0)));
  };
  if (limits.continuous) return std::clamp(velocity, -limits.max_velocity, limits.max_velocity);
  return std::clamp(velocity, -most(position - limits.min_position), most(limits.max_position - position));
}

}  // namespace interpolated_motion::motion
