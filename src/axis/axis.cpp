#include "interpolated_motion_driver/axis/axis.h"

namespace interpolated_motion::axis {

const char* to_string(AxisState state) {
  switch (state) {
    case AxisState::Offline:
      return "offline";
    case AxisState::Configuring:
      return "configuring";
    case AxisState::Disabled:
      return "disabled";
    case AxisState::Enabling:
      return "enabling";
    case AxisState::Ready:
      return "ready";
    case AxisState::Loading:
      return "loading";
    case AxisState::Loaded:
      return "loaded";
    case AxisState::Moving:
      return "moving";
    case AxisState::Stopping:
      return "stopping";
    case AxisState::FaultStopping:
      return "stopping with a fault";
    case AxisState::Fault:
      return "fault";
  }
  return "unknown";
}

}  // namespace interpolated_motion::axis
