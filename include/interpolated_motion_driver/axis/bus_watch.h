#pragma once

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What an axis asks of its bus while it moves, besides the share that its records may fill: for the budget
/// of a bus that carries one exchange at a time. All zero: the bus has room for it beside the records.
struct BusWatch {
  double record_time = 0.0;   ///< s of the bus one record really takes
  double look_time = 0.0;     ///< s of the bus a question about the drive takes, on the average
  double longest_look = 0.0;  ///< s, that a record may have to wait for a question which is under way
  double look_period = 0.0;   ///< s, after which a question goes before records; 0: the axis asks none
  /// From the first record that is sent after the start command to the begin of the path. Zero: what has a
  /// place in the FIFO is loaded before the start.
  GoalTime lead{0.0};
};

}  // namespace interpolated_motion::axis
