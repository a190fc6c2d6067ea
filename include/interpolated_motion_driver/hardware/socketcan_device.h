#pragma once

#include "interpolated_motion_driver/hardware/bus_device.h"
#include "interpolated_motion_driver/transport/socketcan_bus.h"

namespace interpolated_motion::hardware {

/// The CAN interface of a bus with transport `socketcan`.
class SocketcanDevice : public BusDevice {
 public:
  /// Throws std::invalid_argument for a parameter out of its range. An interface that is not there is no
  /// error: it may come.
  SocketcanDevice(EventLoop loop, transport::SocketcanParameters parameters, HostTime now);

  /// For the link of the bus; lives as long as the device, whether or not the interface is there.
  transport::CanBus& bus() { return bus_; }

  bool poll(HostTime now) override;
  HostTime next_deadline() const override { return bus_.next_deadline(); }
  void watch() override;
  bool usable() const override { return bus_.state() == transport::SocketcanState::Up; }
  const std::string& status() const override { return bus_.status_text(); }
  const std::vector<std::string>& advice() const override { return bus_.advice(); }
  std::optional<std::string> take_error() override;
  std::uint64_t error_frames() const override { return counters_.error_frames; }
  std::uint64_t lost_frames() const override { return counters_.receive_overflow + counters_.unconfirmed; }

 private:
  EventLoop loop_;
  transport::SocketcanBus bus_;
  transport::SocketcanCounters counters_;  ///< asked for now and then, since that is a question to the kernel
  HostTime next_count_{};
  bool watching_ = false;
};

}  // namespace interpolated_motion::hardware
