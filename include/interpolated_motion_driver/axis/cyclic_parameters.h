#pragma once

#include <cstdint>
#include <string>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Settings of one drive in the cyclic synchronous position mode.
struct CyclicAxisParameters {
  std::string joint;
  encoding::Transmission transmission;
  trajectory::JointLimits limits;    ///< velocity and acceleration must be finite
  double deviation_bound = 5.0;      ///< counts, at any servo sample
  double max_following_error = 0.1;  ///< rad, 0x6065
  double record_bus_time = 0.0;      ///< s of bus per motion record of the bus' other drives

  HostDuration sync_period =
      std::chrono::milliseconds(10);  ///< between target positions: whole ms, 1..20 (0x60C2)
  int interpolation_order = 3;        ///< of the drive's fine interpolation, 1..3; as its manual says
  double servo_period = 1e-3;         ///< s, between the samples of the fine interpolation
  double velocity_unit = 1.0;         ///< counts/s in one unit of 0x606C
  double acceleration_unit = 1.0;     ///< counts/s^2 in one unit of 0x6084 and 0x6085

  std::uint8_t host_node_id = 127;
  HostDuration heartbeat_period = std::chrono::milliseconds(100);  ///< of the drive, 0x1017
  HostDuration heartbeat_timeout =
      std::chrono::milliseconds(500);  ///< the drive's patience with the host, 0x1016
  HostDuration bring_up_timeout = std::chrono::seconds(5);
  HostDuration feedback_timeout =
      std::chrono::milliseconds(500);  ///< longest silence of position reports in motion

  std::int16_t abort_connection_option = 1;  ///< 0x6007: a lost host is a fault
  std::int16_t fault_reaction_option = 2;    ///< 0x605E: a fault brakes on the quick-stop ramp
};

}  // namespace interpolated_motion::axis
