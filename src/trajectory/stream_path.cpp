#include "interpolated_motion_driver/trajectory/stream_path.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/trajectory/hermite.h"
#include "interpolated_motion_driver/trajectory/stop_path.h"

namespace interpolated_motion::trajectory {

namespace {

/// Shortest piece from the present state to a setpoint.
constexpr GoalTime kShortestPiece{0.002};
/// Delays that are tried: the first, and by how much each is longer than the one before.
constexpr GoalTime kFirstDelay{0.005};
constexpr double kNextDelay = 1.3;

Path then(std::vector<Piece> pieces, const Path& rest) {
  pieces.insert(pieces.end(), rest.pieces().begin(), rest.pieces().end());
  return pieces.empty() ? rest : Path(std::move(pieces));
}

/// What goes on behind a setpoint: straight on, then a stop; or the stop at once, smooth or short.
Expected<Path, LimitViolation> tail(const State& at, GoalTime start, const StreamRules& rules) {
  if (at.velocity == 0.0) return Path(at.position);
  const GoalTime end = start + rules.ride_through;
  const State further{at.position + at.velocity * rules.ride_through.count(), at.velocity, 0.0};
  if (end > start) {
    const Piece straight{start, end, Polynomial{{at.position, at.velocity, 0.0, 0.0, 0.0, 0.0}}};
    Path on = then({straight}, stop_path(further, end, rules.limits));
    if (!find_position_violation(on, rules.limits)) return on;
  }
  Path smooth = stop_path(at, start, rules.limits);
  if (!find_position_violation(smooth, rules.limits)) return smooth;
  Path shortest = shortest_stop_path(at, start, rules.limits);
  if (const auto violation = find_position_violation(shortest, rules.limits)) return *violation;
  return shortest;
}

/// The path that meets the stream, and its velocity, at `reach`: later than the setpoint if that is after
/// `target.time`.
Expected<Path, LimitViolation> reach_at(const State& from, GoalTime start, GoalTime reach,
                                        const StreamTarget& target, const StreamRules& rules) {
  const double position = target.position + target.velocity * (reach - target.time).count();
  const State to{position, target.velocity, 0.0};
  const Piece piece{start, reach, cubic_hermite(from, to, (reach - start).count())};
  if (const auto violation = find_limit_violation(Path({piece}), rules.limits)) return *violation;
  const auto rest = tail(to, reach, rules);
  if (!rest) return rest.error();
  return then({piece}, rest.value());
}

}  // namespace

Expected<Path, LimitViolation> stream_path(const State& from, GoalTime start, const StreamTarget& target,
                                           const StreamRules& rules) {
  const GoalTime earliest = std::max(target.time, start + kShortestPiece);
  const GoalTime latest = std::max(target.time, start) + rules.catch_up;
  auto path = reach_at(from, start, earliest, target, rules);
  for (GoalTime delay = kFirstDelay; !path && earliest + delay <= latest; delay *= kNextDelay) {
    path = reach_at(from, start, earliest + delay, target, rules);
  }
  return path;
}

Path with_rest(const Path& path, GoalTime duration) {
  if (duration <= GoalTime{0.0}) return path;
  const Polynomial standing{{path.final_position()}};
  return then(path.pieces(), Path({{path.end_time(), path.end_time() + duration, standing}}));
}

Path shifted(const Path& path, GoalTime by) {
  std::vector<Piece> pieces = path.pieces();
  for (Piece& piece : pieces) {
    piece.start += by;
    piece.end += by;
  }
  return then(std::move(pieces), Path(path.final_position()));
}

Path splice(const Path& path, GoalTime begin, GoalTime end, const Path& rest) {
  std::vector<Piece> pieces;
  for (const Piece& piece : path.pieces()) {
    if (piece.end <= begin || piece.start >= end) continue;
    pieces.push_back(piece);
    pieces.back().end = std::min(piece.end, end);
  }
  const bool gap = !pieces.empty() && pieces.back().end < end;
  if (gap || (pieces.empty() && end > begin)) {
    const GoalTime from = pieces.empty() ? begin : pieces.back().end;
    const double position = path.sample(from).position;
    pieces.push_back({from, end, Polynomial{{position, 0.0, 0.0, 0.0, 0.0, 0.0}}});
  }
  const std::size_t own = pieces.size();
  pieces.insert(pieces.end(), rest.pieces().begin(), rest.pieces().end());
  if (pieces.empty()) return rest;
  if (own < pieces.size()) pieces[own].start = end;  // which it is but for rounding
  return Path(std::move(pieces));
}

}  // namespace interpolated_motion::trajectory
