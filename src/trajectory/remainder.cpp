#include "interpolated_motion_driver/trajectory/remainder.h"

#include <utility>
#include <vector>

#include "interpolated_motion_driver/trajectory/substituted.h"

namespace interpolated_motion::trajectory {

Path remainder(const Path& path, GoalTime from, double rate) {
  std::vector<Piece> pieces;
  GoalTime start{0.0};
  for (const Piece& piece : path.pieces()) {
    if (piece.end <= from) continue;
    const GoalTime shift = pieces.empty() ? from - piece.start : GoalTime{0.0};
    const GoalTime end = (piece.end - from) / rate;
    if (end <= start) continue;
    pieces.push_back({start, end, substituted(piece.polynomial, shift.count(), rate)});
    start = end;
  }
  return pieces.empty() ? Path(path.final_position()) : Path(std::move(pieces));
}

}  // namespace interpolated_motion::trajectory
