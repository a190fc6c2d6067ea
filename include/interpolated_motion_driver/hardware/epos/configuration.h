#pragma once

#include <memory>

#include "interpolated_motion_driver/emulation/epos/epos_parameters.h"
#include "interpolated_motion_driver/hardware/drive_configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"

namespace interpolated_motion::hardware {

/// What only drives of type `epos_ipm` have.
struct EposSettings : DriveSettings {
  /// counts, DriveConfiguration::deviation_bound where the path is still being made
  double stream_deviation_bound = 8.0;
  emulation::EposParameters emulated;
};

/// Reads it: of `emulation` every setting of emulation::EposParameters that it has under its own name.
/// `drive` holds what all drives have. Throws like ParameterReader.
std::shared_ptr<const EposSettings> parse_epos(ParameterReader& reader, ParameterReader& emulation,
                                               const DriveConfiguration& drive);

}  // namespace interpolated_motion::hardware
