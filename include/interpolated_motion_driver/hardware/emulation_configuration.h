#pragma once

#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"

namespace interpolated_motion::hardware {

/// Reads `drives/<joint>/emulation`: `clock_error_ppm`, `initial_position` (rad), `missing`, and every
/// setting of emulation::EposParameters under its own name. Throws like ParameterReader.
EmulationConfiguration parse_emulation(ParameterReader reader, const DriveConfiguration& drive);

}  // namespace interpolated_motion::hardware
