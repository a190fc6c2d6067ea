#pragma once

#include <string>

#include "interpolated_motion_driver/emulation/epos_drive.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// Commands: `emcy CODE` (error with fault reaction), `power_cycle SECONDS`, `stall 0|1` (the axis is
/// blocked), `silence 0|1` (neither hears nor says anything), `clock PPM` (crystal error). False with a
/// reason for anything else.
bool inject_drive_fault(emulation::EposDrive& drive, const std::string& command, HostTime now,
                        std::string* reason);

/// Commands: `drop COUNT` (the next COUNT frames reach nobody), `drop_id ID COUNT` (the next COUNT frames
/// with that identifier), `disconnect 0|1` (the host's plug is out), `bus_off SECONDS`. Numbers as in C.
/// False with a reason for anything else.
bool inject_bus_fault(transport::VirtualCanBus& bus, const std::string& command, HostTime now,
                      std::string* reason);

}  // namespace interpolated_motion::hardware
