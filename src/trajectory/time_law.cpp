#include "interpolated_motion_driver/trajectory/time_law.h"

#include <algorithm>

namespace interpolated_motion::trajectory {

namespace {

/// When the nominal time of `piece` is `nominal`, between its start and `end`, by which it is reached.
GoalTime within(const TimeLaw::Piece& piece, GoalTime end, GoalTime nominal) {
  if (nominal <= piece.begin.nominal) return piece.start;
  if (piece.is_steady()) return piece.start + (nominal - piece.begin.nominal) / piece.begin.rate;
  constexpr int kHalvings = 60;  // of a piece of any length to less than rounding
  GoalTime before = piece.start;
  GoalTime after = end;
  for (int i = 0; i < kHalvings; ++i) {
    const GoalTime middle = 0.5 * (before + after);
    (piece.at(middle).nominal < nominal ? before : after) = middle;
  }
  return after;
}

}  // namespace

TimeLaw::Instant TimeLaw::Piece::at(GoalTime time) const {
  const double t = (time - start).count();
  const double slope = begin.slope + t * bend;
  const double rate = begin.rate + 0.5 * t * (begin.slope + slope);
  const double passed = t * (begin.rate + t * (begin.slope / 2.0 + t * bend / 6.0));
  return {begin.nominal + GoalTime{passed}, rate, slope};
}

TimeLaw::TimeLaw(double rate, GoalTime when, GoalTime nominal) : pieces_{{when, {nominal, rate, 0.0}, 0.0}} {}

void TimeLaw::bend(GoalTime from, double slope, double bend) {
  Instant begin = at(from);
  begin.slope = slope;
  go_on(from, begin, bend);
}

void TimeLaw::settle(GoalTime from, double rate) { go_on(from, {at(from).nominal, rate, 0.0}, 0.0); }

void TimeLaw::go_on(GoalTime from, const Instant& begin, double bend) {
  while (!pieces_.empty() && pieces_.back().start >= from) pieces_.pop_back();
  pieces_.push_back({from, begin, bend});
}

void TimeLaw::forget(GoalTime time) {
  const auto ends_later = [time](const Piece& piece) { return piece.start > time; };
  const auto kept = std::find_if(pieces_.begin() + 1, pieces_.end(), ends_later);
  pieces_.erase(pieces_.begin(), kept - 1);
}

TimeLaw::Instant TimeLaw::at(GoalTime time) const {
  const auto begins_later = [](GoalTime t, const Piece& piece) { return t < piece.start; };
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time, begins_later);
  return (next - 1)->at(time);
}

std::optional<GoalTime> TimeLaw::when(GoalTime nominal) const {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const bool last = i + 1 == pieces_.size();
    if (last && pieces_[i].begin.rate == 0.0) break;
    if (!last && pieces_[i + 1].begin.nominal < nominal) continue;
    if (pieces_[i].is_steady() && pieces_[i].begin.rate == 0.0) return pieces_[i].start;
    return within(pieces_[i], last ? pieces_[i].start : pieces_[i + 1].start, nominal);
  }
  if (nominal <= pieces_.back().begin.nominal) return pieces_.back().start;
  return std::nullopt;
}

bool TimeLaw::is_identity() const {
  const Piece& only = pieces_.front();
  return pieces_.size() == 1 && only.is_steady() && only.begin.rate == 1.0 &&
         only.begin.nominal == only.start;
}

}  // namespace interpolated_motion::trajectory
