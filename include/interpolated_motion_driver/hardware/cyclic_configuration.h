#pragma once

#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/hardware/parameter_reader.h"

namespace interpolated_motion::hardware {

/// Reads what only drives of type `cyclic` have, their `emulation` included. Throws like ParameterReader.
void parse_cyclic_drive(ParameterReader& reader, DriveConfiguration& drive);

/// Buses with cyclic drives are isochronous. Throws std::invalid_argument where the bus' sync_period is no
/// period of target positions: a whole number of ms, 1..20 (0x60C2), not less than a drive's servo_period.
void mark_isochronous_buses(Configuration& configuration);

/// Bits on the bus at each SYNC for one cyclic drive, at most: target position, status, and the slower
/// reports by their share.
double cyclic_bits_per_sync(const BusConfiguration& bus);

}  // namespace interpolated_motion::hardware
