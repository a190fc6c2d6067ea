#include "interpolated_motion_driver/hardware/drive_parameters.h"

#include <cstdint>

namespace interpolated_motion::hardware {

void set_axis_parameters(axis::AxisParameters& parameters, const DriveConfiguration& drive,
                         const Configuration& all) {
  parameters.joint = drive.joint;
  parameters.transmission = drive.transmission;
  parameters.limits = drive.limits;
  parameters.max_following_error = drive.max_following_error;
  parameters.bring_up_timeout = host_duration(all.bring_up_timeout);
}

void set_cia402_parameters(axis::Cia402AxisParameters& parameters, const DriveConfiguration& drive,
                           const Configuration& all, const CanLink& link) {
  const BusConfiguration& bus = all.bus_of(drive);
  set_axis_parameters(parameters, drive, all);
  parameters.record_bus_time = link.record_bus_time();
  parameters.host_node_id = static_cast<std::uint8_t>(bus.host_node_id);
  parameters.heartbeat_period = host_duration(bus.heartbeat_period);
  parameters.heartbeat_timeout = host_duration(bus.heartbeat_timeout);
  parameters.feedback_timeout = host_duration(bus.feedback_timeout);
}

}  // namespace interpolated_motion::hardware
