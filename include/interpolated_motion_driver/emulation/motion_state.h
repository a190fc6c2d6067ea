#pragma once

namespace interpolated_motion::emulation {

/// Position (counts), velocity (counts/ms) and acceleration (counts/ms^2) of a demand.
struct MotionState {
  double position = 0.0;      ///< counts
  double velocity = 0.0;      ///< counts/ms
  double acceleration = 0.0;  ///< counts/ms^2
};

}  // namespace interpolated_motion::emulation
