#include "interpolated_motion_driver/axis/epos/epos_axis.h"

namespace interpolated_motion::axis {

EposAxis::EposAxis(const EposAxisParameters& parameters, canopen::Master& master, canopen::NodeLink& node)
    : drive_(parameters, master, node),
      stage_({parameters.joint, cia402::Mode::InterpolatedPosition, epos_pdo::kControlwordRpdo,
              parameters.heartbeat_timeout, parameters.bring_up_timeout, parameters.feedback_timeout},
             drive_, master, node),
      player_(stage_, drive_) {
  stage_.attach(player_);
  join(stage_, player_);
}

}  // namespace interpolated_motion::axis
