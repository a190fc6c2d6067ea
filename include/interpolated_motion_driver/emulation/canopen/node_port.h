#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// The node's place on its CAN bus: on it while the node is powered up, unless it is silent.
class NodePort {
 public:
  /// A port of `bus`, which must outlive it, for `listener`.
  NodePort(transport::VirtualCanBus& bus, transport::CanListener& listener)
      : bus_(bus), port_(bus.add_port(listener)) {}

  /// From `now` on the node is on the bus (`powered`) or not; what waits to be sent is lost with it.
  void set_powered(bool powered, HostTime now);

  /// While silent the node is not on the bus, and does not know it.
  void set_silent(bool silent, HostTime now);
  bool silent() const { return silent_; }

  /// Queues a frame. False, and it is lost, when there is no room.
  bool send(const canopen::Frame& frame, HostTime now);

  /// Frames that can be queued before send() fails.
  int free_slots() const { return static_cast<int>(bus_.free_slots(port_)); }

  /// A frame is lost that has not come to send().
  void count_lost() { ++lost_; }

  /// Frames that found no room so far.
  std::uint64_t lost() const { return lost_; }

 private:
  void connect(HostTime now) { bus_.connect(port_, powered_ && !silent_, now); }

  transport::VirtualCanBus& bus_;
  const int port_;
  bool powered_ = false;
  bool silent_ = false;
  std::uint64_t lost_ = 0;
};

}  // namespace interpolated_motion::emulation
