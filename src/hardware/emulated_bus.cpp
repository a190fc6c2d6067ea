#include "interpolated_motion_driver/hardware/emulated_bus.h"

#include "interpolated_motion_driver/emulation/bus_faults.h"

namespace interpolated_motion::hardware {

EmulatedBus add_emulated_bus(emulation::World& world, const BusConfiguration& bus) {
  if (bus.type == BusType::Canopen) return &world.add_can_bus(bus.name, static_cast<int>(bus.bitrate));
  transport::SerialLineParameters parameters;
  parameters.baud = static_cast<int>(bus.serial.line.baud);
  parameters.bits_per_character = bus.serial.line.bits_per_character;
  parameters.wiring = bus.serial.wiring;
  return &world.add_serial_line(bus.name, parameters);
}

std::optional<std::string> inject(EmulatedBus bus, const std::string& command, HostTime now) {
  return std::visit(
      [&](auto* wire) { return emulation::obey_fault(command, emulation::faults_of(*wire, now)); }, bus);
}

}  // namespace interpolated_motion::hardware
