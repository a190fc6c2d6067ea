#pragma once

#include "interpolated_motion_driver/axis/cia402/cia402_parameters.h"

namespace interpolated_motion::axis {

/// Settings of one EPOS drive.
struct EposAxisParameters : Cia402AxisParameters {
  double deviation_bound = 1.0;         ///< counts, at any drive sample
  double stream_deviation_bound = 8.0;  ///< counts, up to which it may be doubled in a stream of setpoints
  double limit_margin = 1.2;    ///< the drive's own fault limits (0x607F, 0x60C5) are the joint's times this
  double commit_horizon = 0.5;  ///< s of motion kept in the drive's FIFO
  double stream_horizon = 0.1;  ///< the same, while setpoints are followed
  /// Without a heartbeat of the host for so long in motion the drive goes into fault (0x1016): not before it
  /// has played what its FIFO holds.
  HostDuration host_watch = std::chrono::milliseconds(2100);
  /// The same at rest; zero: never.
  HostDuration host_watch_at_rest = HostDuration::zero();
  bool clock_discipline = true;  ///< the drive is to set its clock by the master's time stamps (0x1013)
};

}  // namespace interpolated_motion::axis
