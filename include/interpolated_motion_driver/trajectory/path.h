#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// One polynomial of a path and the interval of goal time it is valid on.
struct Piece {
  GoalTime start{0.0};    ///< included
  GoalTime end{0.0};      ///< not included, but for the last piece of a path
  Polynomial polynomial;  ///< in seconds since `start`

  /// Above 0 in a path.
  GoalTime duration() const { return end - start; }
};

/// The motion of one joint over goal time: contiguous polynomial pieces, continuous in position and velocity.
/// Before its first and after its last piece the joint rests at the path's first and last position. A copy
/// takes no time, however long the path: copies share their pieces, which never change.
class Path {
 public:
  /// A path without pieces that rests at `position` for ever.
  explicit Path(double position = 0.0);

  /// `pieces` must be one or more, contiguous (each starts exactly where the one before ends) and each longer
  /// than 0 s. Throws std::invalid_argument with piece and times otherwise.
  explicit Path(std::vector<Piece> pieces);

  /// Whether the path rests at one position for ever.
  bool empty() const { return pieces().empty(); }
  /// Ascending in time, without gaps; none when empty.
  const std::vector<Piece>& pieces() const { return *pieces_; }
  /// Ends of the motion; both 0 when empty.
  GoalTime start_time() const { return empty() ? GoalTime{0.0} : pieces().front().start; }
  GoalTime end_time() const { return empty() ? GoalTime{0.0} : pieces().back().end; }

  /// Position, velocity and acceleration at `time`; at a knot, those of the piece that begins there, at
  /// end_time() those of the last piece.
  State sample(GoalTime time) const;

  /// Where the joint rests after the end.
  double final_position() const;

  /// Index of the piece that holds `time`, searched from `hint` (the index returned last) so that a sweep is
  /// O(1) a step. `time` must be within [start_time(), end_time()] and the path not empty.
  std::size_t piece_index(GoalTime time, std::size_t hint = 0) const;

 private:
  std::shared_ptr<const std::vector<Piece>> pieces_;  ///< never null
  double rest_ = 0.0;
};

}  // namespace interpolated_motion::trajectory
