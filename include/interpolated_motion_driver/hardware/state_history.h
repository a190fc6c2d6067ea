#pragma once

#include <cstddef>
#include <vector>

#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// What was desired of all joints in the last minute, kept at the instants at which the driver looks at
/// itself anyway. Takes its memory once.
class StateHistory {
 public:
  explicit StateHistory(std::size_t joints);

  /// What is desired at `time`, which never runs backwards: one state per joint.
  void add(HostTime time, const std::vector<trajectory::State>& desired);

  /// The states at `time`, a cubic between the two instants around it: with 20 ms between them and 20 rad/s^2
  /// within 0.1 mrad. False, and `out` as it was, where that is not known: over a minute ago, later than the
  /// last instant, or when the driver was away.
  bool at(HostTime time, std::vector<trajectory::State>& out) const;

 private:
  std::size_t place(std::size_t number) const { return (first_ + number) % times_.size(); }
  const trajectory::State& state(std::size_t number, std::size_t joint) const;

  std::size_t joints_;
  std::vector<HostTime> times_;            ///< a ring
  std::vector<trajectory::State> states_;  ///< of all joints at each of them
  std::size_t first_ = 0;                  ///< place of the oldest
  std::size_t count_ = 0;
};

}  // namespace interpolated_motion::hardware
