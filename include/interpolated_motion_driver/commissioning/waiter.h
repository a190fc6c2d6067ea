#pragma once

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::commissioning {

/// Where a session with a bus gets its time from, and what it waits by: the host's clock and the kernel in
/// the program `drive_tool`, an emulation::World in tests.
class Waiter {
 public:
  virtual ~Waiter() = default;

  /// The time now, which never goes back.
  virtual HostTime now() const = 0;
  /// Returns at `limit`, or before it when something may have come over the bus.
  virtual void wait(HostTime limit) = 0;
};

}  // namespace interpolated_motion::commissioning
