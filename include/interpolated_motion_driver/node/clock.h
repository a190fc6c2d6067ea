#pragma once

#include <chrono>

#include <ros/time.h>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::node {

/// The host's monotonic clock, now. The only place above `transport/` that reads it.
HostTime host_now();

/// The same instant for the timers of the standard library and of Boost.Asio.
std::chrono::steady_clock::time_point to_steady(HostTime time);

/// ROS time of a host instant. ROS time may be simulated (`/clock`) and may jump; the driver itself never
/// runs on it, so the conversion is made afresh for every stamp.
ros::Time to_ros_time(HostTime time);

/// Host instant of a ROS stamp, as of now.
HostTime to_host_time(const ros::Time& stamp);

/// Wall clock minus host clock: added to a HostTime it gives the time since the epoch, as log files show it.
HostDuration wall_clock_offset();

}  // namespace interpolated_motion::node
