#include "interpolated_motion_driver/node/clock.h"

namespace interpolated_motion::node {

HostTime host_now() {
  const auto since_boot = std::chrono::steady_clock::now().time_since_epoch();
  return HostTime(std::chrono::duration_cast<HostDuration>(since_boot));
}

std::chrono::steady_clock::time_point to_steady(HostTime time) {
  return std::chrono::steady_clock::time_point(
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(time.time_since_epoch()));
}

ros::Time to_ros_time(HostTime time) {
  const auto now = static_cast<std::int64_t>(ros::Time::now().toNSec());
  const std::int64_t stamp = now + (time - host_now()).count();
  // A simulated clock may still stand near 0, where a stamp of a moment ago would be negative.
  return stamp > 0 ? ros::Time().fromNSec(static_cast<std::uint64_t>(stamp)) : ros::Time();
}

HostTime to_host_time(const ros::Time& stamp) {
  // Not ros::Duration, whose 32 bits a stamp of the far future exceeds.
  const auto ahead =
      static_cast<std::int64_t>(stamp.toNSec()) - static_cast<std::int64_t>(ros::Time::now().toNSec());
  return host_now() + HostDuration(ahead);
}

HostDuration wall_clock_offset() {
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<HostDuration>(wall) - host_now().time_since_epoch();
}

}  // namespace interpolated_motion::node
