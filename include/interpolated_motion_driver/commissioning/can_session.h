#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "interpolated_motion_driver/commissioning/bus_traffic.h"
#include "interpolated_motion_driver/commissioning/progress.h"
#include "interpolated_motion_driver/commissioning/sdo_batch.h"
#include "interpolated_motion_driver/commissioning/waiter.h"
#include "interpolated_motion_driver/transport/can_bus.h"

namespace interpolated_motion::commissioning {

/// One conversation with the nodes of a CAN bus: it listens, reads and writes objects, and sends nothing else
/// than SDO requests.
class CanSession {
 public:
  /// `bitrate` in bit/s, for the load of the bus. `bus` and `waiter` must outlive this.
  CanSession(transport::CanBus& bus, Waiter& waiter, std::uint32_t bitrate,
             const canopen::SdoParameters& parameters = {});

  /// Hears the bus for `duration`.
  void listen(HostDuration duration);

  /// Carries out all orders, see SdoBatch; the results in their order.
  std::vector<canopen::SdoResult> transfer(std::vector<SdoOrder> orders, const Progress& progress = {});
  /// One object.
  canopen::SdoResult read(std::uint8_t node, canopen::ObjectAddress address);
  canopen::SdoResult write(std::uint8_t node, canopen::ObjectAddress address, std::vector<std::uint8_t> data);

  /// For the transfers from now on: storing parameters takes longer than others.
  void set_timeout(HostDuration timeout) { parameters_.timeout = timeout; }
  HostDuration timeout() const { return parameters_.timeout; }

  /// All that has been heard.
  const BusTraffic& traffic() const { return traffic_; }
  HostTime now() const { return waiter_.now(); }

 private:
  void receive(SdoBatch* batch);
  void send(SdoBatch& batch);

  transport::CanBus& bus_;
  Waiter& waiter_;
  canopen::SdoParameters parameters_;
  BusTraffic traffic_;
  std::deque<canopen::Frame> outgoing_;  ///< the bus had no room for them
};

}  // namespace interpolated_motion::commissioning
