#include "interpolated_motion_driver/axis/cyclic/cyclic_axis.h"

#include <algorithm>

namespace interpolated_motion::axis {

CyclicAxis::CyclicAxis(const CyclicAxisParameters& parameters, canopen::Master& master,
                       canopen::NodeLink& node)
    : drive_(parameters, master, node),
      stage_({parameters.joint, cia402::Mode::CyclicSynchronousPosition, cyclic_pdo::kControlwordRpdo,
              parameters.heartbeat_timeout, parameters.bring_up_timeout, parameters.feedback_timeout},
             drive_, master, node),
      player_(stage_, drive_) {
  stage_.attach(player_);
  join(stage_, player_);
}

void CyclicAxis::poll(HostTime now) {
  ComposedAxis::poll(now);
  player_.send_target(now);
}

HostTime CyclicAxis::next_deadline() const {
  return std::min(ComposedAxis::next_deadline(), player_.repeat_due());
}

}  // namespace interpolated_motion::axis
