#pragma once

#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::emulation {

/// An emulated drive on a virtual CAN bus, as the world sees it.
class Device : public transport::CanListener {
 public:
  /// Time of its next own action (sample, response), kNever when it is off for good.
  virtual HostTime next_event() const = 0;

  /// Does what is due at `now`.
  virtual void process(HostTime now) = 0;
};

}  // namespace interpolated_motion::emulation
