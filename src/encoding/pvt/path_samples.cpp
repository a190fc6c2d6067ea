#include "interpolated_motion_driver/encoding/pvt/path_samples.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::encoding {

namespace {

constexpr double kMillisecond = 1e-3;  // s

/// Samples kept before the window is moved to the front of its memory: seldom enough to cost nothing, small
/// enough for the cache.
constexpr std::int64_t kSlack = 4096;

/// An end within 1 ns after a sample belongs to that sample: sums of decimal times are not exact in binary.
constexpr double kEndTolerance = 1e-6;  // ms

std::int64_t last_sample(const trajectory::Path& path) {
  const double duration = (path.end_time() - path.start_time()).count() / kMillisecond;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(duration - kEndTolerance)));
}

}  // namespace

PathSamples::PathSamples(const trajectory::Path& path, const Transmission& transmission, std::int64_t first)
    : path_(&path),
      transmission_(transmission),
      final_position_(transmission.counts(path.final_position())),
      end_(last_sample(path)),
      base_(first) {
  if (!path.empty()) load_piece(0);
  positions_.reserve(2 * kSlack);
  velocities_.reserve(2 * kSlack);
}

void PathSamples::move_window(std::int64_t first, std::int64_t last) {
  if (first - base_ >= kSlack) forget_before(first);
  for (auto k = base_ + static_cast<std::int64_t>(positions_.size()); k <= last; ++k) append_sample(k);
}

void PathSamples::forget_before(std::int64_t first) {
  const auto gone = std::min(positions_.size(), index(first));
  positions_.erase(positions_.begin(), positions_.begin() + static_cast<std::ptrdiff_t>(gone));
  velocities_.erase(velocities_.begin(), velocities_.begin() + static_cast<std::ptrdiff_t>(gone));
  base_ += static_cast<std::int64_t>(gone);
}

void PathSamples::load_piece(std::size_t index) {
  const trajectory::Piece& piece = path_->pieces()[index];
  piece_index_ = index;
  piece_.start = (piece.start - path_->start_time()).count() / kMillisecond;
  piece_.end = (piece.end - path_->start_time()).count() / kMillisecond;
  double scale = transmission_.counts_per_radian();
  for (std::size_t i = 0; i < 6; ++i, scale *= kMillisecond) {
    piece_.position[i] = piece.polynomial.coefficients[i] * scale;
    if (i > 0) piece_.velocity[i - 1] = static_cast<double>(i) * piece_.position[i];
  }
  piece_.position[0] = transmission_.counts(piece.polynomial.coefficients[0]);
}

void PathSamples::append_sample(std::int64_t k) {
  const auto time = static_cast<double>(k);
  while (time >= piece_.end && piece_index_ + 1 < path_->pieces().size()) load_piece(piece_index_ + 1);
  if (path_->empty() || time >= piece_.end) {
    positions_.push_back(final_position_);
    velocities_.push_back(0.0);
    return;
  }
  const double t = time - piece_.start;
  const double* p = piece_.position;
  const double* v = piece_.velocity;
  positions_.push_back(p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * (p[4] + t * p[5])))));
  velocities_.push_back(v[0] + t * (v[1] + t * (v[2] + t * (v[3] + t * v[4]))));
}

}  // namespace interpolated_motion::encoding
