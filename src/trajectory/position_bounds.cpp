#include "interpolated_motion_driver/trajectory/position_bounds.h"

#include <algorithm>
#include <limits>

namespace interpolated_motion::trajectory {

using Numbers = std::numeric_limits<double>;

PositionBounds::PositionBounds(const JointLimits& limits, double start)
    : slack_(limits.position_slack),
      lower_limit_(limits.continuous ? -Numbers::infinity() : limits.min_position),
      upper_limit_(limits.continuous ? Numbers::infinity() : limits.max_position),
      lowest_allowed_(start < lower_limit_ - slack_ ? start : lower_limit_),
      highest_allowed_(start > upper_limit_ + slack_ ? start : upper_limit_) {}

// Between these times the position is monotone.
std::optional<Extremum> PositionBounds::follow(const Piece& piece) {
  const double length = piece.duration().count();
  for (const double turn : position_turns(piece.polynomial, 0.0, length)) {
    if (auto violation = take(turn, piece.polynomial.position(turn))) return violation;
  }
  return take(length, piece.polynomial.position(length));
}

std::optional<Extremum> PositionBounds::take(double time, double position) {
  if (!(position >= lower() && position <= upper())) return Extremum{time, position};
  lowest_allowed_ = std::min(lower_limit_, std::max(lowest_allowed_, position));
  highest_allowed_ = std::max(upper_limit_, std::min(highest_allowed_, position));
  return std::nullopt;
}

}  // namespace interpolated_motion::trajectory
