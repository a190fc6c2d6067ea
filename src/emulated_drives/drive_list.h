#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/emulation/epos/epos_parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/transport/virtual_serial_line.h"
#include "options.h"

namespace interpolated_motion::emulated_drives {

/// A drive to emulate and how commands call it: by its joint, or by its node id or address.
template <class Parameters>
struct NamedDrive {
  std::string name;
  Parameters parameters;
};

/// EPOS2 drives on one CAN interface.
struct CanDrives {
  std::string interface;
  std::uint32_t bitrate = 1'000'000;  ///< bit/s
  std::vector<NamedDrive<emulation::EposParameters>> drives;
};

/// SilverLode drives on one pseudo-terminal.
struct SerialDrives {
  std::string link;
  transport::SerialLineParameters line;
  std::vector<NamedDrive<emulation::SilverDustParameters>> drives;
};

struct DriveList {
  std::vector<CanDrives> can;
  std::vector<SerialDrives> serial;
};

/// The drives that the options ask for, read from the configuration file if there is one. Throws
/// std::invalid_argument or YAML::Exception naming the parameter.
DriveList make_drive_list(const Options& options);

}  // namespace interpolated_motion::emulated_drives
