#pragma once

#include <deque>
#include <optional>
#include <string>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// A sentence about a drive for the log: something that has happened to it, whatever it is doing.
struct AxisNote {
  bool is_problem = true;  ///< false: something is over, or is only to be known
  std::string text;        ///< with joint, bus and node
};

/// Notes that wait to be taken. A drive that has more to tell than `kMost` in a second is told of in part,
/// and what was left out is counted.
class AxisNotes {
 public:
  static constexpr int kMost = 10;

  void add(AxisNote note, HostTime now);
  /// The oldest; nothing if there is none.
  std::optional<AxisNote> take() {
    if (notes_.empty()) return std::nullopt;
    return take_oldest();
  }

 private:
  AxisNote take_oldest();

  std::deque<AxisNote> notes_;
  HostTime second_begin_ = HostTime::min();
  int in_second_ = 0;
  int left_out_ = 0;
};

}  // namespace interpolated_motion::axis
