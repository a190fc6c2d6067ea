#pragma once

#include "interpolated_motion_driver/hardware/bus_device.h"
#include "interpolated_motion_driver/transport/serial_port_line.h"

namespace interpolated_motion::hardware {

/// The serial port of a bus with transport `serial`.
class SerialPortDevice : public BusDevice {
 public:
  /// Throws std::invalid_argument for a parameter out of its range. A port that is not there is no error: it
  /// may come.
  SerialPortDevice(EventLoop loop, transport::SerialPortParameters parameters, HostTime now);

  /// For the link of the bus; lives as long as the device, whether or not the port is there.
  transport::SerialLine& line() { return line_; }

  bool poll(HostTime now) override { return line_.poll_port(now); }
  HostTime next_deadline() const override { return line_.next_deadline(); }
  void watch() override;
  bool usable() const override { return line_.state() == transport::SerialPortState::Open; }
  const std::string& status() const override { return line_.status_text(); }
  const std::vector<std::string>& advice() const override { return line_.advice(); }
  /// None: a tty reports no errors of the line, the master finds them in the text.
  std::optional<std::string> take_error() override { return std::nullopt; }
  std::uint64_t error_frames() const override { return 0; }
  std::uint64_t lost_frames() const override { return 0; }

 private:
  EventLoop loop_;
  transport::SerialPortLine line_;
  bool watching_ = false;
};

}  // namespace interpolated_motion::hardware
