#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::encoding {

/// A joint's path in counts, not rounded, at a drive's servo ticks. The ticks lie on the path's goal time by
/// an origin (a tick and its goal time) and the goal seconds per tick, which may change from any tick on.
/// Holds a window of ticks that only moves forward, so the memory used does not depend on the length of the
/// path.
class TickSamples {
 public:
  /// `path` must outlive this object. Memory for a window of `window` ticks is taken at once.
  TickSamples(const trajectory::Path& path, const Transmission& transmission, std::int64_t window);

  /// Begins anew: tick `first` is at `goal_time`, and each tick after it `seconds_per_tick` (> 0) later.
  void restart(std::int64_t first, GoalTime goal_time, double seconds_per_tick);

  /// First tick after the origin at which the path rests for good.
  std::int64_t end() const { return end_; }

  /// Where the path is at `tick`, which may lie before the origin or behind the end.
  GoalTime goal_time(std::int64_t tick) const {
    return GoalTime(origin_time_ + static_cast<double>(tick - origin_) * seconds_per_tick_);
  }

  /// Makes the ticks up to `last` readable.
  void extend_to(std::int64_t last) {
    while (base_ + static_cast<std::int64_t>(positions_.size()) <= last) append();
  }

  /// Forgets the ticks before `first`, which must be in the window.
  void forget_before(std::int64_t first);

  /// Counts at `tick`, which must be readable, and behind the pointer at the ticks that follow.
  const double* counts_from(std::int64_t tick) const {
    return positions_.data() + static_cast<std::size_t>(tick - base_);
  }

  /// Where the path rests behind its end, counts, not rounded.
  double final_counts() const { return final_counts_; }

 private:
  /// One piece of the path in counts, over ticks since the piece's start.
  struct ScaledPiece {
    double start = 0.0;           ///< ticks since the origin
    double end = 0.0;             ///< ticks since the origin
    double coefficients[6] = {};  ///< counts/tick^i, of the ticks since `start`
  };

  void load_piece(std::size_t index);
  void append();

  const trajectory::Path* path_;
  Transmission transmission_;
  double final_counts_;
  std::int64_t slack_;
  std::int64_t origin_ = 0;
  double origin_time_ = 0.0;  ///< s
  double seconds_per_tick_ = 1.0;
  std::int64_t end_ = 0;
  std::int64_t base_ = 0;  ///< first tick of the window
  std::size_t piece_index_ = 0;
  ScaledPiece piece_;
  std::vector<double> positions_;
};

}  // namespace interpolated_motion::encoding
