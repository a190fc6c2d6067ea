#include "interpolated_motion_driver/emulation/canopen/node_port.h"

namespace interpolated_motion::emulation {

void NodePort::set_powered(bool powered, HostTime now) {
  powered_ = powered;
  connect(now);
}

void NodePort::set_silent(bool silent, HostTime now) {
  silent_ = silent;
  connect(now);
}

bool NodePort::send(const canopen::Frame& frame, HostTime now) {
  if (silent_) return true;
  const bool taken = bus_.send(port_, frame, now);
  if (!taken) ++lost_;
  return taken;
}

}  // namespace interpolated_motion::emulation
