#pragma once

#include <memory>

#include "interpolated_motion_driver/emulation/cyclic/cyclic_parameters.h"
#include "interpolated_motion_driver/hardware/bus_configuration.h"
#include "interpolated_motion_driver/hardware/drive_configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"

namespace interpolated_motion::hardware {

/// What only drives of type `cyclic` have.
struct CyclicSettings : DriveSettings {
  int interpolation_order = 3;           ///< of the drive's fine interpolation, 1..3
  double stream_deviation_bound = 40.0;  ///< counts
  double servo_period = 1e-3;            ///< s, between the samples of the fine interpolation
  double velocity_unit = 1.0;            ///< counts/s in one unit of 0x606C
  double acceleration_unit = 1.0;        ///< counts/s^2 in one unit of 0x6084 and 0x6085
  bool velocity_feedforward = true;      ///< 0x60B1 goes with each target position
  double torque_per_acceleration = 0.0;  ///< per mille of the rated torque for 1 rad/s^2 (m/s^2), 0x60B2
  emulation::CyclicParameters emulated;  ///< what the emulated drive is; agrees with the settings above
};

/// Reads it. `drive` holds what all drives have. Throws like ParameterReader.
std::shared_ptr<const CyclicSettings> parse_cyclic(ParameterReader& reader, ParameterReader& emulation,
                                                   const DriveConfiguration& drive);

/// Throws std::invalid_argument where the bus' sync_period is no period of target positions: a whole number
/// of ms, 1..20 (0x60C2), not less than the drive's servo_period.
void check_sync_period(const DriveConfiguration& drive, const BusConfiguration& bus);

}  // namespace interpolated_motion::hardware
