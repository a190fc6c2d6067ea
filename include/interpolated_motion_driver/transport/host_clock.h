#pragma once

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

/// The host's monotonic clock (CLOCK_MONOTONIC), now.
HostTime read_host_clock();

/// The host's wall clock (CLOCK_REALTIME), since 1970. Kernel time stamps of received frames are in it.
HostDuration read_wall_clock();

}  // namespace interpolated_motion::transport
