#include "interpolated_motion_driver/trajectory/retime.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "interpolated_motion_driver/trajectory/hermite.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/trajectory/substituted.h"

namespace interpolated_motion::trajectory {

namespace {

constexpr GoalTime kForEver{std::numeric_limits<double>::infinity()};
/// Shorter pieces are left out, their time is their neighbour's.
constexpr GoalTime kNothing{1e-9};
/// So short a quintic is lost in rounding, and differs from a parabola by less.
constexpr GoalTime kShort{1e-4};

/// Of a nominal piece at an instant of the law: the chain rule.
State state_at(const Piece& piece, const TimeLaw::Instant& now) {
  const State nominal = piece.polynomial.state((now.nominal - piece.start).count());
  return {nominal.position, nominal.velocity * now.rate,
          nominal.acceleration * now.rate * now.rate + nominal.velocity * now.slope};
}

/// Goes along the pieces of a path and those of a law together.
class Retiming {
 public:
  Retiming(const Path& nominal, const TimeLaw& law, GoalTime from)
      : nominal_(nominal), law_(law), time_(from) {
    while (law_piece_ + 1 < law.pieces().size() && law.pieces()[law_piece_ + 1].start <= from) ++law_piece_;
    const GoalTime reached = std::clamp(law.at(from).nominal, nominal.start_time(), nominal.end_time());
    piece_ = nominal.piece_index(reached);
  }

  Path run(GoalTime until) {
    while (time_ < until && piece_ < nominal_.pieces().size()) {
      const GoalTime end = next_knot();
      if (end == kForEver) break;
      if (end - time_ > kNothing) add(end);
      advance();
    }
    return pieces_.empty() ? Path(standing()) : Path(std::move(pieces_));
  }

 private:
  const Piece& piece() const { return nominal_.pieces()[piece_]; }
  const TimeLaw::Piece& law() const { return law_.pieces()[law_piece_]; }
  GoalTime law_end() const {
    return law_piece_ + 1 < law_.pieces().size() ? law_.pieces()[law_piece_ + 1].start : kForEver;
  }

  /// Where the nominal path or the law has its next one.
  GoalTime next_knot() {
    const auto of_path = law_.when(piece().end);
    path_is_next_ = of_path && *of_path < law_end() - kNothing;
    return path_is_next_ ? *of_path : law_end();
  }

  void advance() { path_is_next_ ? ++piece_ : ++law_piece_; }

  void add(GoalTime end) {
    pieces_.push_back({time_, end, polynomial(end)});
    time_ = end;
  }

  Polynomial polynomial(GoalTime end) const {
    const TimeLaw::Instant begin = law().at(time_);
    if (law().is_steady() && begin.rate == 0.0) return {{state_at(piece(), begin).position}};
    if (law().is_steady())
      return substituted(piece().polynomial, (begin.nominal - piece().start).count(), begin.rate);
    const State from = state_at(piece(), begin);
    if (end - time_ < kShort) return {{from.position, from.velocity, 0.5 * from.acceleration}};
    return quintic_hermite(from, state_at(piece(), law().at(end)), (end - time_).count());
  }

  double standing() const { return nominal_.sample(law_.at(time_).nominal).position; }

  const Path& nominal_;
  const TimeLaw& law_;
  std::size_t piece_ = 0;
  std::size_t law_piece_ = 0;
  bool path_is_next_ = false;
  GoalTime time_;
  std::vector<Piece> pieces_;
};

}  // namespace

Path retimed(const Path& nominal, const TimeLaw& law, GoalTime from, GoalTime until) {
  if (nominal.empty()) return nominal;
  const auto begin = law.when(nominal.start_time());
  if (!begin) return Path(nominal.sample(nominal.start_time()).position);
  return Retiming(nominal, law, std::max(from, *begin)).run(until);
}

}  // namespace interpolated_motion::trajectory
