#include "interpolated_motion_driver/encoding/ims/tick_samples.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::encoding {

namespace {

/// An end within a nanosecond or so after a tick belongs to that tick: sums of decimal times are not exact in
/// binary.
constexpr double kEndTolerance = 1e-5;  // ticks

/// Ticks kept before the window is moved to the front of its memory, seldom enough to cost nothing.
constexpr std::int64_t kSlack = 8192;

}  // namespace

TickSamples::TickSamples(const trajectory::Path& path, const Transmission& transmission, std::int64_t window)
    : path_(&path),
      transmission_(transmission),
      final_counts_(transmission.counts(path.final_position())),
      slack_(kSlack) {
  positions_.reserve(static_cast<std::size_t>(window + 2 * slack_));
}

void TickSamples::restart(std::int64_t first, GoalTime goal_time, double seconds_per_tick) {
  origin_ = first;
  origin_time_ = goal_time.count();
  seconds_per_tick_ = seconds_per_tick;
  const double left = (path_->end_time().count() - origin_time_) / seconds_per_tick_;
  end_ = first + std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(left - kEndTolerance)));
  base_ = first;
  positions_.clear();
  if (path_->empty()) return;
  const GoalTime inside = std::min(std::max(goal_time, path_->start_time()), path_->end_time());
  load_piece(path_->piece_index(inside));
}

void TickSamples::forget_before(std::int64_t first) {
  if (first - base_ < slack_) return;
  positions_.erase(positions_.begin(), positions_.begin() + static_cast<std::ptrdiff_t>(first - base_));
  base_ = first;
}

void TickSamples::load_piece(std::size_t index) {
  const trajectory::Piece& piece = path_->pieces()[index];
  piece_index_ = index;
  piece_.start = (piece.start.count() - origin_time_) / seconds_per_tick_;
  piece_.end = (piece.end.count() - origin_time_) / seconds_per_tick_;
  double scale = transmission_.counts_per_radian();
  for (std::size_t i = 0; i < 6; ++i, scale *= seconds_per_tick_) {
    piece_.coefficients[i] = piece.polynomial.coefficients[i] * scale;
  }
  piece_.coefficients[0] = transmission_.counts(piece.polynomial.coefficients[0]);
}

void TickSamples::append() {
  const auto tick = static_cast<double>(base_ - origin_ + static_cast<std::int64_t>(positions_.size()));
  while (tick >= piece_.end && piece_index_ + 1 < path_->pieces().size()) load_piece(piece_index_ + 1);
  if (path_->empty() || tick >= piece_.end) {
    positions_.push_back(final_counts_);
    return;
  }
  const double t = std::max(0.0, tick - piece_.start);
  const double* c = piece_.coefficients;
  positions_.push_back(c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5])))));
}

}  // namespace interpolated_motion::encoding
