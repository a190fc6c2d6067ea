#include "interpolated_motion_driver/hardware/serial_port_device.h"

#include <utility>

namespace interpolated_motion::hardware {

SerialPortDevice::SerialPortDevice(EventLoop loop, transport::SerialPortParameters parameters, HostTime now)
    : loop_(std::move(loop)), line_(*loop_.io, std::move(parameters), now) {}

void SerialPortDevice::watch() {
  if (watching_ || !usable()) return;
  watching_ = true;
  line_.async_wait_readable([this](const boost::system::error_code&) {
    watching_ = false;
    loop_.wake();
  });
}

}  // namespace interpolated_motion::hardware
