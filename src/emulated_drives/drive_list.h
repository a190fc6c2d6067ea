#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/emulation/epos_parameters.h"
#include "options.h"

namespace interpolated_motion::emulated_drives {

/// A drive to emulate and how commands call it: by its joint, or by its node id.
struct NamedDrive {
  std::string name;
  emulation::EposParameters parameters;
};

struct DriveList {
  std::uint32_t bitrate = 1'000'000;  ///< bit/s
  std::vector<NamedDrive> drives;
};

/// The drives that the options ask for, read from the configuration file if there is one. Throws
/// std::invalid_argument or YAML::Exception naming the parameter.
DriveList make_drive_list(const Options& options);

}  // namespace interpolated_motion::emulated_drives
