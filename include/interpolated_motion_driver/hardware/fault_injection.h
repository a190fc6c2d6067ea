#pragma once

#include <string>

#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"
#include "interpolated_motion_driver/emulation/silverdust/silverdust.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/transport/virtual_serial_line.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// Commands: `emcy CODE` (error with fault reaction), `power_cycle SECONDS`, `stall 0|1` (the axis is
/// blocked), `silence 0|1` (neither hears nor says anything), `clock PPM` (crystal error). False with a
/// reason for anything else.
bool inject_drive_fault(emulation::EposDrive& drive, const std::string& command, HostTime now,
                        std::string* reason);

bool inject_drive_fault(emulation::CyclicDrive& drive, const std::string& command, HostTime now,
                        std::string* reason);

/// Commands: `drop COUNT` (the next COUNT frames reach nobody), `drop_id ID COUNT` (the next COUNT frames
/// with that identifier), `disconnect 0|1` (the host's plug is out), `bus_off SECONDS`. Numbers as in C.
/// False with a reason for anything else.
bool inject_bus_fault(transport::VirtualCanBus& bus, const std::string& command, HostTime now,
                      std::string* reason);

/// Commands: `fault over_temperature|over_voltage|low_voltage|moving_error|holding_error`, `power_cycle
/// SECONDS`, `stall 0|1`, `silence 0|1`, `clock PPM`, `nak COMMAND CODE COUNT` (the next COUNT commands with
/// that number are refused). False with a reason for anything else.
bool inject_drive_fault(emulation::SilverDust& drive, const std::string& command, HostTime now,
                        std::string* reason);

/// Commands: `lose_requests COUNT`, `lose_replies COUNT` (the next COUNT characters towards or from the
/// drives reach nobody), `garble_requests COUNT`, `garble_replies COUNT` (they arrive wrong), `garbage TEXT`
/// (the host receives what nobody has sent), `disconnect 0|1`. False with a reason for anything else.
bool inject_line_fault(transport::VirtualSerialLine& line, const std::string& command, HostTime now,
                       std::string* reason);

}  // namespace interpolated_motion::hardware
