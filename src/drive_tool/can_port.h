#pragma once

#include <cstdint>

#include "interpolated_motion_driver/commissioning/bus_advice.h"
#include "interpolated_motion_driver/commissioning/can_session.h"
#include "interpolated_motion_driver/transport/socketcan_bus.h"
#include "kernel_waiter.h"
#include "options.h"

namespace interpolated_motion::drive_tool {

/// A CAN interface of the kernel, and a session on it.
class CanPort {
 public:
  /// Throws std::runtime_error in a sentence when the interface cannot be used.
  explicit CanPort(const Options& options);
  CanPort(const CanPort&) = delete;
  CanPort& operator=(const CanPort&) = delete;

  commissioning::CanSession& session() { return session_; }
  const transport::CanInterface& interface() const { return interface_; }
  /// Reported by the controller so far.
  const commissioning::BusErrors& errors() const { return errors_; }

 private:
  bool turn(HostTime now);
  const transport::CanInterface& open_interface();

  KernelWaiter waiter_;
  transport::SocketcanBus bus_;
  transport::CanInterface interface_;
  commissioning::BusErrors errors_;
  commissioning::CanSession session_;
};

}  // namespace interpolated_motion::drive_tool
