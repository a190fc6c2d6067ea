#pragma once

#include <string>
#include <vector>

#include "interpolated_motion_driver/axis/start_signal.h"
#include "interpolated_motion_driver/hardware/wire_observer.h"
#include "interpolated_motion_driver/motion/snapshot.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// One bus with its master: carries what is sent and received between the master and the transport.
class BusLink : public axis::StartSignal {
 public:
  virtual const std::string& name() const = 0;

  /// Gives the master everything that has arrived.
  virtual void receive(const WireObserver& observer) = 0;
  /// Lets the master do what time demands.
  virtual void poll(HostTime now) = 0;
  /// Hands the transport everything that is due and that it takes.
  virtual void send(HostTime now) = 0;
  virtual HostTime next_deadline() const = 0;

  virtual motion::BusSnapshot snapshot() const = 0;
  virtual double peak_load() const = 0;  ///< 0..1, since reset_peak_load()
  virtual void reset_peak_load() = 0;
  /// Sentences about traffic that nobody was waiting for.
  virtual std::vector<std::string> unexpected_traffic() const = 0;
};

}  // namespace interpolated_motion::hardware
