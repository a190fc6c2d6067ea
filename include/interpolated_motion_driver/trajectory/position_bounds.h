#pragma once

#include <optional>

#include "interpolated_motion_driver/trajectory/extrema.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/path.h"

namespace interpolated_motion::trajectory {

/// How far out a path may be, piece by piece: within the limits; and where it begins outside of them, no
/// farther out than it has come in.
class PositionBounds {
 public:
  /// Of a path that begins at `start` (rad or m).
  PositionBounds(const JointLimits& limits, double start);

  /// With slack; infinite for a continuous joint. Where the path is still outside, it is the bound that its
  /// way in has come to.
  double lower() const { return lowest_allowed_ - slack_; }
  double upper() const { return highest_allowed_ + slack_; }
  /// The path is outside of the limits yet.
  bool outside() const { return lowest_allowed_ < lower_limit_ || highest_allowed_ > upper_limit_; }

  /// Follows the next piece: where it is first farther out than it may be, if anywhere. To be called for
  /// every piece as long as the path is outside.
  std::optional<Extremum> follow(const Piece& piece);

 private:
  std::optional<Extremum> take(double time, double position);

  double slack_;
  double lower_limit_;
  double upper_limit_;
  double lowest_allowed_;
  double highest_allowed_;
};

}  // namespace interpolated_motion::trajectory
