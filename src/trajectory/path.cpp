#include "interpolated_motion_driver/trajectory/path.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::trajectory {

namespace {

void check_pieces(const std::vector<Piece>& pieces) {
  if (pieces.empty())
    throw std::invalid_argument("path: no pieces; a path that rests is made from a position");
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    if (!(piece.duration().count() > 0.0)) {
      throw std::invalid_argument(fmt::format("path: piece {} from {} s to {} s must be longer than 0 s", i,
                                              piece.start.count(), piece.end.count()));
    }
    if (i > 0 && !(piece.start == pieces[i - 1].end)) {
      throw std::invalid_argument(
          fmt::format("path: piece {} starts at {} s, but must at {} s where piece {} ends", i,
                      piece.start.count(), pieces[i - 1].end.count(), i - 1));
    }
  }
}

/// All paths that rest share these.
const std::shared_ptr<const std::vector<Piece>>& no_pieces() {
  static const auto none = std::make_shared<const std::vector<Piece>>();
  return none;
}

bool holds(const Piece& piece, GoalTime time) { return piece.start <= time && time < piece.end; }

}  // namespace

Path::Path(double position) : pieces_(no_pieces()), rest_(position) {}

Path::Path(std::vector<Piece> pieces)
    : pieces_(std::make_shared<const std::vector<Piece>>(std::move(pieces))) {
  check_pieces(*pieces_);
  const Piece& last = pieces_->back();
  rest_ = last.polynomial.position(last.duration().count());
}

State Path::sample(GoalTime time) const {
  if (empty() || time > end_time()) return {rest_, 0.0, 0.0};
  if (time < start_time()) return {pieces().front().polynomial.position(0.0), 0.0, 0.0};
  const Piece& piece = pieces()[piece_index(time)];
  return piece.polynomial.state((time - piece.start).count());
}

double Path::final_position() const { return rest_; }

std::size_t Path::piece_index(GoalTime time, std::size_t hint) const {
  const std::vector<Piece>& all = pieces();
  const std::size_t last = all.size() - 1;
  for (std::size_t i = hint; i <= last && i <= hint + 1; ++i) {
    if (holds(all[i], time)) return i;
  }
  const auto ends_later = [](GoalTime t, const Piece& piece) { return t < piece.end; };
  const auto found = std::upper_bound(all.begin(), all.end(), time, ends_later);
  return std::min(static_cast<std::size_t>(found - all.begin()), last);
}

}  // namespace interpolated_motion::trajectory
