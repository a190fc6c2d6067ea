#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::encoding {

/// A joint's path as the motor sees it at the drive's 1 ms samples: position in counts and velocity in
/// counts/ms, neither rounded. Sample k belongs to goal time path.start_time() + k ms. Holds a window of
/// samples that only moves forward, so the memory used does not depend on the length of the path.
class PathSamples {
 public:
  /// `path` must outlive this object. The window starts at sample `first` >= 0.
  PathSamples(const trajectory::Path& path, const Transmission& transmission, std::int64_t first = 0);

  /// First sample at which the path rests for good: its duration in ms, rounded up, at least 1.
  std::int64_t end() const { return end_; }

  /// Lets the path rest until sample `end` at least.
  void rest_until(std::int64_t end) { end_ = end > end_ ? end : end_; }

  /// Makes samples first..last readable and forgets those before `first`, which must not be less than at the
  /// last call.
  void move_window(std::int64_t first, std::int64_t last);

  double position(std::int64_t k) const { return positions_[index(k)]; }   ///< counts; k in the window
  double velocity(std::int64_t k) const { return velocities_[index(k)]; }  ///< counts/ms; k in the window
  /// Position of sample `k`, counts, and behind the pointer those of the samples that follow in the window.
  const double* positions_from(std::int64_t k) const { return positions_.data() + index(k); }

  double final_position() const { return final_position_; }  ///< counts

 private:
  /// One piece of the path in counts and in ms since the piece's start.
  struct ScaledPiece {
    double start = 0.0;       ///< ms since the path's start
    double end = 0.0;         ///< ms since the path's start
    double position[6] = {};  ///< counts/ms^i, of the ms since `start`
    double velocity[5] = {};  ///< its derivative, counts/ms^(i + 1)
  };

  std::size_t index(std::int64_t k) const { return static_cast<std::size_t>(k - base_); }
  void load_piece(std::size_t index);
  void append_sample(std::int64_t k);
  void forget_before(std::int64_t first);

  const trajectory::Path* path_;
  Transmission transmission_;
  double final_position_;
  std::int64_t end_;
  std::int64_t base_;
  std::size_t piece_index_ = 0;
  ScaledPiece piece_;
  std::vector<double> positions_;
  std::vector<double> velocities_;
};

}  // namespace interpolated_motion::encoding
