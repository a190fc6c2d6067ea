#include "simulation/goal_maker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/random.h"

namespace interpolated_motion::simulation {

namespace {

// Greatest slopes and curvatures of the two parts of the curve over s = 0..1.
constexpr double kStepSlope = 1.875;
constexpr double kStepCurvature = 5.7735;
constexpr double kBumpSlope = 0.0537;
constexpr double kBumpCurvature = 0.375;  // at the middle, 6 (1/4)^2
/// Share of the way to a limit that a goal may use: curves through points leave it.
constexpr double kRoom = 0.9;
constexpr double kShortest = 0.2;  // s

struct Curve {
  double start = 0.0;
  double step = 0.0;
  double bump = 0.0;

  double position(double s) const {
    const double u = s - s * s;
    return start + step * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s) + bump * u * u * u;
  }
  double slope(double s) const {
    const double u = s - s * s;
    return 30.0 * step * u * u + 3.0 * bump * u * u * (1.0 - 2.0 * s);
  }
  double curvature(double s) const {
    const double u = s - s * s;
    const double w = 1.0 - 2.0 * s;
    return 60.0 * step * u * w + bump * (6.0 * u * w * w - 6.0 * u * u);
  }
};

Curve random_curve(Random& random, const Joint& joint, double start, double reach) {
  const double middle = 0.5 * (joint.min_position + joint.max_position);
  const double half = 0.5 * kRoom * (joint.max_position - joint.min_position);
  const double end = std::clamp(start + reach * random.number(-1.0, 1.0), middle - half, middle + half);
  Curve curve{start, end - start, 0.0};
  if (random.chance(0.5)) curve.bump = 8.0 * reach * random.number(-1.0, 1.0);
  return curve;
}

double duration_of(const Curve& curve, const Joint& joint, double effort) {
  const double slope = kStepSlope * std::abs(curve.step) + kBumpSlope * std::abs(curve.bump);
  const double curvature = kStepCurvature * std::abs(curve.step) + kBumpCurvature * std::abs(curve.bump);
  return std::max(slope / (effort * joint.max_velocity),
                  std::sqrt(curvature / (effort * joint.max_acceleration)));
}

/// Shapes: 0 positions, 1 and velocities, 2 and accelerations, 3 positions with a stop at each.
void add_joint(const Curve& curve, double duration, double s, int shape, trajectory::Waypoint& point) {
  point.positions.push_back(curve.position(s));
  if (shape == 1 || shape == 2) point.velocities.push_back(curve.slope(s) / duration);
  if (shape == 2) point.accelerations.push_back(curve.curvature(s) / (duration * duration));
  if (shape == 3) point.velocities.push_back(0.0);
}

void spoil(trajectory::Goal& goal, GoalDefect defect, const Arm& arm, double present) {
  trajectory::Waypoint& last = goal.points.back();
  switch (defect) {
    case GoalDefect::BeyondLimit:
      last.positions[0] = arm.joints.front().max_position + 0.5;
      last.time += GoalTime{20.0};
      return;
    case GoalDefect::StartElsewhere: {
      trajectory::Waypoint first = last;
      first.time = GoalTime{0.0};
      first.positions[0] = present + 1.0;
      if (goal.points.front().time == GoalTime{0.0}) goal.points.erase(goal.points.begin());
      goal.points.insert(goal.points.begin(), first);
      return;
    }
    case GoalDefect::EndsInMotion:
      last.velocities.assign(last.positions.size(), 0.1);
      for (auto& point : goal.points) point.velocities.resize(point.positions.size(), 0.0);
      return;
    case GoalDefect::NotANumber:
      last.positions[0] = std::numeric_limits<double>::quiet_NaN();
      return;
    case GoalDefect::UnknownJoint:
      goal.joint_names[0] = "elbow";
      return;
    case GoalDefect::None:
      return;
  }
}

}  // namespace

GoalDefect defect_of(const Event& event) {
  return static_cast<GoalDefect>(static_cast<int>(event.number("bad")));
}

trajectory::Goal make_goal(const Event& event, const Arm& arm, const std::vector<double>& present,
                           HostTime now) {
  Random random(static_cast<std::uint64_t>(event.number("noise", 1.0)));
  const int shape = static_cast<int>(event.number("shape"));
  const int points = std::max(1, static_cast<int>(event.number("points", 1.0)));
  const double all = static_cast<double>(arm.joints.size());
  const auto joints = static_cast<std::size_t>(std::clamp(event.number("joints", all), 1.0, all));
  // Through a stop at each point a curve is steeper: 15/8 of its mean slope.
  const double effort = event.number("effort", 0.5) * (shape == 3 ? 0.3 : 1.0);
  trajectory::Goal goal;
  std::vector<Curve> curves;
  double duration = kShortest;
  for (std::size_t j = 0; j < joints; ++j) {
    goal.joint_names.push_back(arm.joints[j].name);
    curves.push_back(random_curve(random, arm.joints[j], present[j], event.number("reach", 0.5)));
    duration = std::max(duration, duration_of(curves[j], arm.joints[j], effort));
  }
  for (int i = event.number("first") != 0.0 ? 0 : 1; i <= points; ++i) {
    trajectory::Waypoint point;
    const double s = static_cast<double>(i) / points;
    point.time = GoalTime{s * duration};
    for (const Curve& curve : curves) add_joint(curve, duration, s, shape, point);
    goal.points.push_back(point);
  }
  if (event.numbers.count("stamp") > 0) goal.start = now + host_duration(event.number("stamp"));
  spoil(goal, defect_of(event), arm, present.front());
  return goal;
}

trajectory::Goal make_stop(const Arm& arm) {
  trajectory::Goal goal;
  for (const Joint& joint : arm.joints) goal.joint_names.push_back(joint.name);
  return goal;
}

}  // namespace interpolated_motion::simulation
