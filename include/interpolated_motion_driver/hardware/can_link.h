#pragma once

#include <memory>
#include <string>
#include <vector>

#include "interpolated_motion_driver/hardware/bus_link.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/transport/can_bus.h"

namespace interpolated_motion::hardware {

/// One CAN bus with its CANopen master. Its start signal is SYNC.
class CanLink : public BusLink {
 public:
  /// `bus` must live as long as the link or, if it is that of `device`, as the device.
  CanLink(const BusConfiguration& configuration, transport::CanBus& bus,
          std::unique_ptr<BusDevice> device = nullptr);

  /// Axes add their nodes to it; it lives as long as the link.
  canopen::Master& master() { return master_; }
  const std::string& name() const override { return master_.bus_name(); }

  void receive(const WireObserver& observer) override;
  void poll(HostTime now) override { master_.poll(now); }
  void signal(HostTime now) override { master_.request_sync(now); }

  double peak_load() const override { return peak_load_; }
  void reset_peak_load() override { peak_load_ = 0.0; }
  std::uint64_t unexpected() const override;
  std::vector<std::string> unexpected_traffic() const override;

  /// Share of the bus that one motion record takes, s.
  double record_bus_time() const;

 protected:
  HostTime master_deadline() const override { return master_.next_deadline(); }
  void send_outgoing(HostTime now) override;
  void clear_outgoing() override { master_.clear_outgoing(); }
  void fill_traffic(motion::BusSnapshot& out) const override;

 private:
  transport::CanBus& bus_;
  canopen::Master master_;
  std::uint64_t sent_ = 0;
  std::uint64_t received_ = 0;
  double peak_load_ = 0.0;
};

}  // namespace interpolated_motion::hardware
