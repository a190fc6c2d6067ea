#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"

namespace interpolated_motion::axis {

SilverlodeAxis::SilverlodeAxis(const SilverlodeAxisParameters& parameters, silverlode::LineMaster& line,
                               silverlode::DeviceLink& device, LineStart* common_start)
    : stage_(parameters, line, device), player_(stage_, common_start) {
  stage_.attach(player_);
  join(stage_, player_);
}

}  // namespace interpolated_motion::axis
