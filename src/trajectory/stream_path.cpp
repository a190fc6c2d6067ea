#include "interpolated_motion_driver/trajectory/stream_path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/trajectory/hermite.h"
#include "interpolated_motion_driver/trajectory/jerk_limited_stop.h"
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

/// Ramps of acceleration that are tried behind a setpoint.
constexpr GoalTime kRamps[] = {GoalTime{0.03}, GoalTime{0.06}, GoalTime{0.12}};
/// Of the limit, for a stop with ramps: what a drive makes of them goes beyond it.
constexpr double kBrakingShare = 0.9;

/// A slow joint takes longer than the limit of acceleration makes it: jerk has no more than this many per s
/// times that limit.
constexpr double kJerk = 50.0;

Path smooth_stop(const State& from, GoalTime start, JointLimits limits) {
  // stop_path() takes 1.5 v / a, and its jerk is 6 v over the square of that at most.
  const double gentle = std::sqrt(0.375 * kJerk * limits.max_acceleration * std::abs(from.velocity));
  if (from.velocity != 0.0) limits.max_acceleration = std::min(limits.max_acceleration, gentle);
  return stop_path(from, start, limits);
}

/// One way to a setpoint, and what may go on behind it.
class WayOn {
 public:
  /// `piece` arrives at `at`.
  WayOn(const Piece& piece, const State& at, const StreamRules& rules)
      : piece_(piece), rules_(rules), at_(at), ride_end_(piece.end + rules.ride_through) {}

  /// Straight on, then a stop; or the stop at once, smooth or short.
  Expected<Path, LimitViolation> plain() {
    State at = at_;
    at.acceleration = 0.0;
    if (at.velocity == 0.0 && take(Path(at.position))) return path_;
    if (at.velocity == 0.0) return why_;
    if (rides()) {
      const Polynomial even{{at.position, at.velocity}};
      const State further = even.state((ride_end_ - piece_.end).count());
      const Path stop = smooth_stop(further, ride_end_, rules_.limits);
      if (take(then({{piece_.end, ride_end_, even}}, stop))) return path_;
    }
    if (take(smooth_stop(at, piece_.end, rules_.limits))) return path_;
    if (take(shortest_stop_path(at, piece_.end, rules_.limits))) return path_;
    return why_;
  }

  /// The same, or with ramps of acceleration.
  Expected<Path, LimitViolation> ramped() {
    if (at_.acceleration == 0.0) {
      auto path = plain();
      if (path || at_.velocity == 0.0) return path;
    }
    for (const GoalTime ramp : kRamps) {
      if (rides() && take(eased(ramp))) return path_;
      if (take(stop(at_, piece_.end, ramp))) return path_;
      if (failed_before_) break;
    }
    return why_;
  }

 private:
  bool rides() const { return ride_end_ > piece_.end; }

  Path stop(const State& from, GoalTime start, GoalTime ramp) const {
    return jerk_limited_stop(from, start, {kBrakingShare * rules_.limits.max_acceleration, ramp});
  }

  Path eased(GoalTime ramp) const {
    const double t = ramp.count();
    const Polynomial ease{
        {at_.position, at_.velocity, 0.5 * at_.acceleration, -at_.acceleration / (6.0 * t)}};
    State state = ease.state(t);
    state.acceleration = 0.0;
    const GoalTime eased = piece_.end + ramp;
    const GoalTime end = std::max(eased, ride_end_);
    std::vector<Piece> pieces{{piece_.end, eased, ease}};
    if (end > eased) pieces.push_back({eased, end, Polynomial{{state.position, state.velocity}}});
    state.position += state.velocity * (end - eased).count();
    const Path rest = stop(state, end, ramp);
    return then(std::move(pieces), rest);
  }

  bool take(const Path& tail) {
    if (failed_before_) return false;
    Path path = then({piece_}, tail);
    auto violation = find_limit_violation(path, rules_.limits);
    if (!violation && rules_.demand) violation = rules_.demand(path);
    if (violation) {
      why_ = *violation;
      failed_before_ = violation->time < piece_.end;
      return false;
    }
    path_ = std::move(path);
    return true;
  }

  const Piece piece_;
  const StreamRules& rules_;
  const State at_;
  const GoalTime ride_end_;
  Path path_;
  LimitViolation why_;
  bool failed_before_ = false;  ///< on the way to the setpoint: no tail helps
};

/// The path that meets the stream, and its velocity, at `reach`: later than the setpoint if that is after
/// `target.time`.
Expected<Path, LimitViolation> reach_at(const State& from, GoalTime start, GoalTime reach,
                                        const StreamTarget& target, const StreamRules& rules) {
  const double position = target.position + target.velocity * (reach - target.time).count();
  const State to{position, target.velocity, 0.0};
  const double duration = (reach - start).count();
  const auto way_on = [&](const Polynomial& polynomial, const State& at) {
    return WayOn({start, reach, polynomial}, at, rules);
  };
  auto path = way_on(cubic_hermite(from, to, duration), to).plain();
  if (path || !rules.demand) return path;
  path = way_on(quintic_hermite(from, to, duration), to).ramped();
  if (path || to.velocity == 0.0) return path;
  const Polynomial smoothest = least_jerk(from, to, duration);
  return way_on(smoothest, {to.position, to.velocity, smoothest.state(duration).acceleration}).ramped();
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

GoalTime rest_begin(const Path& path) {
  const auto stands = [](const Piece& piece) {
    const auto& c = piece.polynomial.coefficients;
    return std::all_of(c.begin() + 1, c.end(), [](double value) { return value == 0.0; });
  };
  const auto& pieces = path.pieces();
  const auto last = std::find_if_not(pieces.rbegin(), pieces.rend(), stands);
  return last == pieces.rend() ? path.start_time() : last->end;
}

Path shifted(const Path& path, GoalTime by) {
  std::vector<Piece> pieces;
  pieces.reserve(path.pieces().size());
  for (Piece piece : path.pieces()) {
    piece.start = pieces.empty() ? piece.start + by : pieces.back().end;
    piece.end += by;
    if (piece.end > piece.start) pieces.push_back(piece);  // shorter than rounding leaves nothing of
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
