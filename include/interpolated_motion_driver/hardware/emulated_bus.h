#pragma once

#include <optional>
#include <string>
#include <variant>

#include "interpolated_motion_driver/emulation/world.h"
#include "interpolated_motion_driver/hardware/bus_configuration.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/transport/virtual_serial_line.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// An emulated bus of whatever type. Lives in a world.
using EmulatedBus = std::variant<transport::VirtualCanBus*, transport::VirtualSerialLine*>;

/// A new bus in `world` with the name, the type and the timing of `bus`, wherever its drives are. Throws
/// std::invalid_argument when the name is taken or a value is out of range.
EmulatedBus add_emulated_bus(emulation::World& world, const BusConfiguration& bus);

/// Makes the bus fail; commands as in emulation/bus_faults.h. Returns why not.
std::optional<std::string> inject(EmulatedBus bus, const std::string& command, HostTime now);

}  // namespace interpolated_motion::hardware
