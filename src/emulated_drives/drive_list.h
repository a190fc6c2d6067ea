#pragma once

#include <vector>

#include "interpolated_motion_driver/hardware/bus_configuration.h"
#include "interpolated_motion_driver/hardware/drive_configuration.h"
#include "options.h"

namespace interpolated_motion::emulated_drives {

/// Drives to emulate on one bus, of whatever kinds go there. Commands call a drive by its joint, or by its
/// node id or address.
struct ServedBus {
  hardware::BusConfiguration bus;  ///< its name is that of the CAN interface, or of the link to the terminal
  std::vector<hardware::DriveConfiguration> drives;
};

/// The drives that the options ask for, read from the configuration file if there is one. Throws
/// std::invalid_argument or YAML::Exception naming the parameter.
std::vector<ServedBus> make_drive_list(const Options& options);

}  // namespace interpolated_motion::emulated_drives
