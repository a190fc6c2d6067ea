#pragma once

#include <string>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// What makes all armed axes of one bus obey at the same instant. On CANopen: SYNC, which lets every drive
/// take the controlword it received before.
class StartSignal {
 public:
  virtual ~StartSignal() = default;
  /// Sends the signal behind everything that has been commanded on this bus before.
  virtual void signal(HostTime now) = 0;
  /// Why the bus carries nothing at present, in one sentence with what to do. Empty when it does, or when
  /// that is not known.
  virtual std::string fault() const { return {}; }
};

}  // namespace interpolated_motion::axis
