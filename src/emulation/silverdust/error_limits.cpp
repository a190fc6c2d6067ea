#include "interpolated_motion_driver/emulation/silverdust/error_limits.h"

namespace interpolated_motion::emulation {

void ErrorLimits::restart() {
  set(delivered_.moving_error_limit, delivered_.holding_error_limit, delivered_.holding_delay);
  countdown_ = 0;
  largest_ = 0;
}

void ErrorLimits::set(int moving, int holding, int delay) {
  moving_ = moving;
  holding_ = holding;
  delay_ = delay;
}

}  // namespace interpolated_motion::emulation
