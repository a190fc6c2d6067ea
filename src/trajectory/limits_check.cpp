#include "interpolated_motion_driver/trajectory/limits_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "interpolated_motion_driver/trajectory/extrema.h"
#include "interpolated_motion_driver/trajectory/position_bounds.h"

namespace interpolated_motion::trajectory {

namespace {

/// The limits with their slack.
struct Bounds {
  Bounds(const JointLimits& limits, const PositionBounds& positions)
      : lower(positions.lower()),
        upper(positions.upper()),
        velocity(limits.max_velocity * (1.0 + limits.rate_slack)),
        acceleration(limits.max_acceleration * (1.0 + limits.rate_slack)) {}

  double lower;
  double upper;
  double velocity;
  double acceleration;
};

bool within(double value, double lower, double upper) { return value >= lower && value <= upper; }

template <std::size_t Size>
bool all_within(const std::array<double, Size>& values, double lower, double upper) {
  bool result = true;
  for (const double value : values) result &= within(value, lower, upper);
  return result;
}

/// Differences between neighbouring control points: those of the derivative, up to a factor.
template <std::size_t Size>
std::array<double, Size - 1> differences(const std::array<double, Size>& points) {
  std::array<double, Size - 1> result{};
  for (std::size_t i = 0; i + 1 < Size; ++i) result[i] = points[i + 1] - points[i];
  return result;
}

/// Bernstein control points of the position, less its first value, over a piece of `length` s.
std::array<double, 6> control_points(const Polynomial& polynomial, double length) {
  const auto& c = polynomial.coefficients;
  const double t2 = length * length;
  const double a1 = c[1] * length * 0.2;
  const double a2 = c[2] * t2 * 0.1;
  const double a3 = c[3] * t2 * length * 0.1;
  const double a4 = c[4] * t2 * t2 * 0.2;
  const double a5 = c[5] * t2 * t2 * length;
  return {0.0,
          a1,
          2 * a1 + a2,
          3 * a1 + 3 * a2 + a3,
          4 * a1 + 6 * a2 + 4 * a3 + a4,
          5 * a1 + 10 * a2 + 10 * a3 + 5 * a4 + a5};
}

/// Whether the hulls of the control points, which contain the polynomials, are within. Ten times quicker than
/// the extrema and enough for all but the few pieces near a limit.
bool surely_within(const Polynomial& polynomial, double length, const Bounds& bounds) {
  const auto position = control_points(polynomial, length);
  const auto velocity = differences(position);
  const auto acceleration = differences(velocity);
  const double origin = polynomial.coefficients[0];
  const double max_first = bounds.velocity * length / 5.0;
  const double max_second = bounds.acceleration * length * length / 20.0;
  return all_within(position, bounds.lower - origin, bounds.upper - origin) &&
         all_within(velocity, -max_first, max_first) && all_within(acceleration, -max_second, max_second);
}

/// The end of `range` that is farther outside.
Extremum worst(const Range& range, double lower, double upper) {
  return lower - range.minimum.value > range.maximum.value - upper ? range.minimum : range.maximum;
}

std::optional<LimitViolation> violation(Quantity quantity, const Piece& piece, const Range& range,
                                        double lower, double upper, const Range& allowed) {
  if (within(range.minimum.value, lower, upper) && within(range.maximum.value, lower, upper))
    return std::nullopt;
  const Extremum extremum = worst(range, lower, upper);
  const bool at_knot = extremum.time == 0.0 || extremum.time == piece.duration().count();
  return LimitViolation{quantity,
                        piece.start + GoalTime(extremum.time),
                        extremum.value,
                        allowed.minimum.value,
                        allowed.maximum.value,
                        at_knot,
                        std::nullopt};
}

Range symmetric(double limit) { return {{0.0, -limit}, {0.0, limit}}; }

std::optional<LimitViolation> exact_violation(const Piece& piece, const JointLimits& limits,
                                              const Bounds& bounds) {
  const double length = piece.duration().count();
  const Polynomial& p = piece.polynomial;
  const Range positions{{0.0, limits.min_position}, {0.0, limits.max_position}};
  if (const auto v = violation(Quantity::Position, piece, position_range(p, 0.0, length), bounds.lower,
                               bounds.upper, positions)) {
    return v;
  }
  if (const auto v = violation(Quantity::Velocity, piece, velocity_range(p, 0.0, length), -bounds.velocity,
                               bounds.velocity, symmetric(limits.max_velocity))) {
    return v;
  }
  return violation(Quantity::Acceleration, piece, acceleration_range(p, 0.0, length), -bounds.acceleration,
                   bounds.acceleration, symmetric(limits.max_acceleration));
}

LimitViolation way_in_violation(const Piece& piece, const Extremum& farther, double start,
                                const JointLimits& limits) {
  const bool at_knot = farther.time == piece.duration().count();
  const GoalTime time = piece.start + GoalTime(farther.time);
  return {Quantity::Position, time, farther.value, limits.min_position, limits.max_position, at_knot, start};
}

/// By how much the time has to be stretched to bring a velocity or an acceleration back to its limit.
double stretch(const LimitViolation& violation) {
  const double ratio = std::abs(violation.value) / violation.maximum;
  return violation.quantity == Quantity::Velocity ? ratio : std::sqrt(ratio);
}

/// Beyond its limit by no more than this part, a velocity or an acceleration may have come there by rounding.
constexpr double kLittle = 0.05;

/// Where a velocity or an acceleration beyond its limit comes from.
std::string cause(const LimitViolation& violation) {
  const double excess = std::abs(violation.value) / violation.maximum - 1.0;
  if (excess <= kLittle) {
    return fmt::format(
        "It is {:.2g} % more, as rounding of the points makes it where the planner has the same limits: give "
        "the "
        "planner {:.2f} of them, or raise plan_margin of the joint. ",
        100.0 * excess, std::floor(100.0 / (1.0 + excess)) / 100.0);
  }
  if (violation.at_knot)
    return "A point asks for it itself: the planner's limits are wider than the joint's. ";
  return "The curve between two points does: give accelerations with the points, or more points. ";
}

std::string advice(JointUnit unit, const LimitViolation& violation) {
  if (violation.begins_outside) {
    return fmt::format(
        "The joint stands outside, at {:.7g} {}: from there only the way in is allowed, and not out again.",
        *violation.begins_outside, symbol(unit));
  }
  if (violation.quantity == Quantity::Position) {
    const char* where =
        violation.at_knot ? "A point is outside. " : "The curve between two points is outside. ";
    return std::string(where) + "Plan within the joint's limits, or correct them.";
  }
  return cause(violation) +
         fmt::format("Slow the trajectory down by a factor of {:.4g} or more, or correct the joint's limits.",
                     std::ceil(1000.0 * stretch(violation)) / 1000.0);
}

}  // namespace

std::optional<LimitViolation> find_limit_violation(const Path& path, const JointLimits& limits) {
  if (path.pieces().empty()) return std::nullopt;
  const double start = path.pieces().front().polynomial.position(0.0);
  PositionBounds positions(limits, start);
  for (const Piece& piece : path.pieces()) {
    const Bounds bounds(limits, positions);
    if (positions.outside()) {
      if (const auto farther = positions.follow(piece))
        return way_in_violation(piece, *farther, start, limits);
    }
    if (surely_within(piece.polynomial, piece.duration().count(), bounds)) continue;
    if (const auto found = exact_violation(piece, limits, bounds)) return found;
  }
  return std::nullopt;
}

std::optional<LimitViolation> find_position_violation(const Path& path, const JointLimits& limits) {
  JointLimits positions = limits;
  positions.max_velocity = std::numeric_limits<double>::infinity();
  positions.max_acceleration = std::numeric_limits<double>::infinity();
  return find_limit_violation(path, positions);
}

Refusal limit_refusal(const std::string& joint, JointUnit unit, const LimitViolation& violation) {
  return {
      GoalError::InvalidGoal,
      fmt::format("{0}: the {1} reaches {2:.7g} {6} at {3:.6f} s, allowed is {4:.7g} to {5:.7g} {6}. {7}",
                  joint, name(violation.quantity), violation.value, violation.time.count(), violation.minimum,
                  violation.maximum, symbol(unit, violation.quantity), advice(unit, violation))};
}

}  // namespace interpolated_motion::trajectory
