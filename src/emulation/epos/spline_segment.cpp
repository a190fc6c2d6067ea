#include "interpolated_motion_driver/emulation/epos/spline_segment.h"

namespace interpolated_motion::emulation {

SplineSegment::SplineSegment(const MotionState& start, const MotionState& end, double duration)
    : c_(end.velocity), d_(end.position), duration_(duration) {
  const double back = start.position - end.position;
  b_ = (3.0 * back + duration * (start.velocity + 2.0 * end.velocity)) / (duration * duration);
  a_ = (2.0 * back + duration * (start.velocity + end.velocity)) / (duration * duration * duration);
}

}  // namespace interpolated_motion::emulation
