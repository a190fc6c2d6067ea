#pragma once

#include "interpolated_motion_driver/axis/cia402/cia402_parameters.h"

namespace interpolated_motion::axis {

/// Settings of one drive in the cyclic synchronous position mode.
struct CyclicAxisParameters : Cia402AxisParameters {
  double deviation_bound = 5.0;          ///< counts, at any servo sample
  double stream_deviation_bound = 40.0;  ///< counts, the same in a stream of setpoints
  double limit_margin = 1.2;             ///< the demand may exceed the joint's acceleration by this factor
  HostDuration sync_period =
      std::chrono::milliseconds(10);  ///< between target positions: whole ms, 1..20 (0x60C2)
  int interpolation_order = 3;        ///< of the drive's fine interpolation, 1..3; as its manual says
  double servo_period = 1e-3;         ///< s, between the samples of the fine interpolation
  double velocity_unit = 1.0;         ///< counts/s in one unit of 0x606C
  /// The velocity of the path goes with each target position (0x60B1), where the drive takes it.
  bool velocity_feedforward = true;
  /// Per mille of the rated torque for 1 rad/s^2 (m/s^2) of the joint (0x60B2), where the drive takes it; 0:
  /// none is sent.
  double torque_per_acceleration = 0.0;
  double acceleration_unit = 1.0;  ///< counts/s^2 in one unit of 0x6084 and 0x6085
};

}  // namespace interpolated_motion::axis
