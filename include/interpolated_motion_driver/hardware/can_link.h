#pragma once

#include <functional>
#include <string>

#include "interpolated_motion_driver/axis/start_signal.h"
#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"
#include "interpolated_motion_driver/transport/can_bus.h"

namespace interpolated_motion::hardware {

using WireObserver = std::function<void(const std::string& bus, const canopen::ReceivedFrame&)>;

/// One CAN bus with its CANopen master: carries frames between the two.
class CanLink : public axis::StartSignal {
 public:
  /// `bus` must outlive the link.
  CanLink(const BusConfiguration& configuration, transport::CanBus& bus);

  canopen::Master& master() { return master_; }
  const std::string& name() const { return master_.bus_name(); }

  /// Gives the master every frame that has arrived.
  void receive(const WireObserver& observer);
  /// Hands the bus every frame that is due and that it takes.
  void send(HostTime now);

  void signal(HostTime now) override { master_.request_sync(now); }

  motion::BusSnapshot snapshot() const;
  /// Share of the bus that one motion record takes, s.
  double record_bus_time() const;

  void reset_peak_load() { peak_load_ = 0.0; }
  double peak_load() const { return peak_load_; }

 private:
  transport::CanBus& bus_;
  canopen::Master master_;
  std::uint64_t sent_ = 0;
  std::uint64_t received_ = 0;
  double peak_load_ = 0.0;
};

}  // namespace interpolated_motion::hardware
