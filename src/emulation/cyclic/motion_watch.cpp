#include "interpolated_motion_driver/emulation/cyclic/motion_watch.h"

#include <utility>

namespace interpolated_motion::emulation {

void MotionWatch::take(bool following, double demand) {
  const bool changed = std::exchange(demand_, demand) != demand;
  const bool followed = std::exchange(followed_, following);
  const bool was_moving = moving_;
  stood_ = changed ? 0 : stood_ + 1;
  moving_ = following && (was_moving ? stood_ < rest_ : followed && changed);
  if (moving_) samples_ = was_moving ? samples_ + 1 : 0;
}

}  // namespace interpolated_motion::emulation
