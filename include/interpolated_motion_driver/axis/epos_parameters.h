#pragma once

#include <cstdint>
#include <string>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Settings of one EPOS drive.
struct EposAxisParameters {
  std::string joint;
  encoding::Transmission transmission;
  trajectory::JointLimits limits;       ///< velocity and acceleration must be finite
  double deviation_bound = 1.0;         ///< counts, at any drive sample
  double stream_deviation_bound = 8.0;  ///< counts, up to which it may be doubled in a stream of setpoints
  double limit_margin = 1.2;  ///< the drive's own fault limits (0x607F, 0x60C5) are the joint's times this
  double max_following_error = 0.1;  ///< rad, 0x6065
  double commit_horizon = 2.0;       ///< s of motion kept in the drive's FIFO
  double stream_horizon = 0.1;       ///< the same, while setpoints are followed
  double record_bus_time = 0.0;      ///< s of bus per record, as share of what records may fill

  std::uint8_t host_node_id = 127;
  bool clock_discipline = true;  ///< the drive is to set its clock by the master's time stamps (0x1013)
  HostDuration heartbeat_period = std::chrono::milliseconds(100);  ///< of the drive, 0x1017
  HostDuration heartbeat_timeout =
      std::chrono::milliseconds(500);  ///< the drive's patience with the host, 0x1016
  HostDuration bring_up_timeout = std::chrono::seconds(5);
  HostDuration feedback_timeout =
      std::chrono::milliseconds(500);  ///< longest silence of position reports in motion

  /// Reaction of the drive to a lost host (0x6007): 1 fault, which brakes on the quick-stop ramp and then
  /// needs a reset. The meaning of the values on EPOS2 is that of CiA 402; maxon's documents at hand do not
  /// list them.
  std::int16_t abort_connection_option = 1;
  /// Fault reaction (0x605E): 2, brake on the quick-stop ramp.
  std::int16_t fault_reaction_option = 2;
};

}  // namespace interpolated_motion::axis
