#pragma once

#include <string>

#include "interpolated_motion_driver/commissioning/line_session.h"
#include "interpolated_motion_driver/transport/serial_port_line.h"
#include "kernel_waiter.h"
#include "options.h"

namespace interpolated_motion::drive_tool {

/// A serial port of the kernel, and a session on its line.
class LinePort {
 public:
  /// At `baud` bit/s. Throws std::runtime_error in a sentence when the port cannot be used.
  LinePort(const Options& options, int baud);
  LinePort(const LinePort&) = delete;
  LinePort& operator=(const LinePort&) = delete;

  commissioning::LineSession& session() { return session_; }

 private:
  bool turn(HostTime now);

  KernelWaiter waiter_;
  transport::SerialPortLine line_;
  commissioning::LineSession session_;
};

}  // namespace interpolated_motion::drive_tool
