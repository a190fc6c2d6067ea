#include "interpolated_motion_driver/trajectory/path_builder.h"

#include <stdexcept>
#include <utility>

#include "interpolated_motion_driver/trajectory/hermite.h"
#include "interpolated_motion_driver/trajectory/shape_preserving.h"

namespace interpolated_motion::trajectory {

namespace {

double length(const Knot& from, const Knot& to) { return (to.time - from.time).count(); }

double slope(const Knot& from, const Knot& to) {
  return (to.state.position - from.state.position) / length(from, to);
}

double velocity_at(const std::vector<Knot>& knots, std::size_t i) {
  const Knot& knot = knots[i];
  if (knot.given != KnotData::Position) return knot.state.velocity;
  if (i == 0 || i + 1 == knots.size()) return 0.0;
  return velocity_between(knots[i - 1], knot, knots[i + 1]);
}

Polynomial segment(const Knot& from, const State& start, const Knot& to, const State& end) {
  const bool accelerations = from.given == KnotData::Acceleration && to.given == KnotData::Acceleration;
  const double duration = length(from, to);
  return accelerations ? quintic_hermite(start, end, duration) : cubic_hermite(start, end, duration);
}

}  // namespace

double velocity_between(const Knot& before, const Knot& knot, const Knot& after) {
  return shape_preserving_slope(length(before, knot), slope(before, knot), length(knot, after),
                                slope(knot, after));
}

void append_pieces(const std::vector<Knot>& knots, std::vector<Piece>& pieces) {
  if (knots.size() < 2) throw std::invalid_argument("path: fewer than two knots");
  State start = knots.front().state;
  start.velocity = velocity_at(knots, 0);
  for (std::size_t i = 1; i < knots.size(); ++i) {
    State end = knots[i].state;
    end.velocity = velocity_at(knots, i);
    pieces.push_back({knots[i - 1].time, knots[i].time, segment(knots[i - 1], start, knots[i], end)});
    start = end;
  }
}

Path build_path(const std::vector<Knot>& knots) {
  std::vector<Piece> pieces;
  pieces.reserve(knots.size());
  append_pieces(knots, pieces);
  return Path(std::move(pieces));
}

}  // namespace interpolated_motion::trajectory
