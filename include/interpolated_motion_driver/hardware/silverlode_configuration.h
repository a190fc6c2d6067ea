#pragma once

#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"

namespace interpolated_motion::hardware {

/// Reads what a bus of type `silverlode` has besides type and transport. Throws like ParameterReader.
void parse_serial_line(ParameterReader& reader, BusConfiguration& bus);

/// Reads what a drive of type `silverlode_ims` has besides what all drives have; `drive` holds the latter
/// already. `emulation` is that of an emulated drive. Throws like ParameterReader.
void parse_silverlode_drive(ParameterReader& reader, DriveConfiguration& drive);

}  // namespace interpolated_motion::hardware
