#include "interpolated_motion_driver/trajectory/remainder.h"

#include <utility>
#include <vector>

namespace interpolated_motion::trajectory {

namespace {

/// q(t) = p(shift + rate * t): the Taylor coefficients of p at `shift`, by repeated Horner division, times
/// powers of `rate`.
Polynomial substituted(const Polynomial& p, double shift, double rate) {
  auto c = p.coefficients;
  for (std::size_t low = 0; low + 1 < c.size(); ++low) {
    for (std::size_t i = c.size() - 1; i > low; --i) c[i - 1] += shift * c[i];
  }
  double power = 1.0;
  for (double& coefficient : c) {
    coefficient *= power;
    power *= rate;
  }
  return {c};
}

}  // namespace

Path remainder(const Path& path, GoalTime from, double rate) {
  std::vector<Piece> pieces;
  GoalTime start{0.0};
  for (const Piece& piece : path.pieces()) {
    if (piece.end <= from) continue;
    const GoalTime shift = pieces.empty() ? from - piece.start : GoalTime{0.0};
    const GoalTime end = (piece.end - from) / rate;
    if (end <= start) continue;
    pieces.push_back({start, end, substituted(piece.polynomial, shift.count(), rate)});
    start = end;
  }
  return pieces.empty() ? Path(path.final_position()) : Path(std::move(pieces));
}

}  // namespace interpolated_motion::trajectory
