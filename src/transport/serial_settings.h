#pragma once

#include <string>

#include "interpolated_motion_driver/transport/serial_port_line.h"

/// The system calls that set a tty up. Those that can fail return 0 or the errno.
namespace interpolated_motion::transport {

/// Raw mode, frame format and baud rate, any by BOTHER (asm/termbits.h); EINVAL when the device rounds the
/// rate by more than 2 %, which is about what 8N2 characters bear on both sides together.
int set_line_settings(int fd, const SerialPortParameters& parameters);

/// Other programs cannot open the tty any more (TIOCEXCL), nor lock it (flock, as terminal programs do).
int lock_port(int fd);
/// Ends both before the port is closed: a pseudo-terminal lives on, and would stay exclusive.
void unlock_port(int fd);

int set_low_latency(int fd);
int set_rs485(int fd);

/// Drops what has been left in the buffers before.
void discard_old(int fd);

}  // namespace interpolated_motion::transport
