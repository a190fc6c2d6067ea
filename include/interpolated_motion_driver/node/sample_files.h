#pragma once

#include <string>
#include <vector>

#include "interpolated_motion_driver/hardware/demand_sample.h"

namespace interpolated_motion::node {

/// The samples at which a drive interpolated, from a file that `emulated_drives --samples` has written; none
/// when there is no such file, or no regular one. A line that cannot be read ends the list.
std::vector<hardware::DemandSample> read_sample_file(const std::string& path);

}  // namespace interpolated_motion::node
