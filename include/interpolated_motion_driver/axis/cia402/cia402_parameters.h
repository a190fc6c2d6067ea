#pragma once

#include <cstdint>

#include "interpolated_motion_driver/axis/axis_parameters.h"

namespace interpolated_motion::axis {

/// Settings of one CiA 402 drive on CANopen.
struct Cia402AxisParameters : AxisParameters {
  double record_bus_time = 0.0;     ///< s of bus per motion record, as share of what records may fill
  std::uint8_t host_node_id = 127;  ///< 1..127: whose heartbeat the drive watches
  HostDuration heartbeat_period = std::chrono::milliseconds(100);  ///< of the drive, 0x1017
  HostDuration heartbeat_timeout =
      std::chrono::milliseconds(500);  ///< the drive's patience with the host, 0x1016
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
