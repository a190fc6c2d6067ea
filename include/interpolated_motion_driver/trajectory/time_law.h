#pragma once

#include <optional>
#include <vector>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// How fast a motion is gone along: nominal time s, that of its paths as they were wished for, over goal time
/// t, in which they are executed. All joints have the same one, so that they stay on their common way. The
/// rate ds/dt is never negative and continuous: 1 as wished, 0 paused.
class TimeLaw {
 public:
  /// At one instant.
  struct Instant {
    GoalTime nominal{0.0};  ///< s
    double rate = 1.0;      ///< ds/dt, >= 0
    double slope = 0.0;     ///< of the rate, per s
  };

  /// From `start` on until the next piece.
  struct Piece {
    GoalTime start{0.0};  ///< goal time
    Instant begin;        ///< there
    double bend = 0.0;    ///< of the rate, per s^2, constant

    /// At goal time `time`, not limited to the piece.
    Instant at(GoalTime time) const;
    /// The rate does not change.
    bool is_steady() const { return begin.slope == 0.0 && bend == 0.0; }
  };

  /// Always at `rate` >= 0; at goal time `when` the motion is at `nominal`.
  explicit TimeLaw(double rate = 1.0, GoalTime when = GoalTime{0.0}, GoalTime nominal = GoalTime{0.0});

  /// The same until `from`, which is behind the begin of the law; then the rate goes on with this slope and
  /// bend.
  void bend(GoalTime from, double slope, double bend);
  /// The same until `from`; then at `rate`, for ever. It must be the rate there but for rounding.
  void settle(GoalTime from, double rate);
  /// Forgets what was before `time`.
  void forget(GoalTime time);

  /// At goal time `time`; before the first piece as in it.
  Instant at(GoalTime time) const;
  /// The earliest goal time at which the motion is at `nominal`; nothing if it does not come there.
  std::optional<GoalTime> when(GoalTime nominal) const;
  /// The rate at the end, and since when.
  double final_rate() const { return pieces_.back().begin.rate; }
  GoalTime steady_from() const { return pieces_.back().start; }
  /// Goal time is nominal time.
  bool is_identity() const;
  /// One or more, ascending; the last one is steady and has no end.
  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  void go_on(GoalTime from, const Instant& begin, double bend);

  std::vector<Piece> pieces_;
};

}  // namespace interpolated_motion::trajectory
