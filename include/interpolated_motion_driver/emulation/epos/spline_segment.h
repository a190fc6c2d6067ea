#pragma once

#include "interpolated_motion_driver/emulation/motion_state.h"

namespace interpolated_motion::emulation {

/// One cubic of "EPOS3 Interpolated Position Mode", 4.2.3: P(t) = a s^3 + b s^2 + c s + d with s = t - t0, t0
/// the END of the segment, so that s runs from -T to 0. The coefficients a and b printed there miss the
/// segment's start; those here have n and n-1 exchanged, as the reading at s = -T demands.
class SplineSegment {
 public:
  SplineSegment() = default;

  /// From `start` to `end` (position and velocity of each), `duration` ms > 0.
  SplineSegment(const MotionState& start, const MotionState& end, double duration);

  /// State `elapsed` ms after the segment's start, 0..duration.
  MotionState at(double elapsed) const {
    const double s = elapsed - duration_;
    return {((a_ * s + b_) * s + c_) * s + d_, (3.0 * a_ * s + 2.0 * b_) * s + c_, 6.0 * a_ * s + 2.0 * b_};
  }

  /// T, ms; 0 of a segment made by default.
  double duration() const { return duration_; }

 private:
  double a_ = 0.0;
  double b_ = 0.0;
  double c_ = 0.0;
  double d_ = 0.0;
  double duration_ = 0.0;
};

}  // namespace interpolated_motion::emulation
