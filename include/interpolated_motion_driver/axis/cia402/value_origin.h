#pragma once

#include <string>

#include "interpolated_motion_driver/axis/axis_parameters.h"

namespace interpolated_motion::axis {

/// Where a value that a drive is given comes from, for the sentence about one that refuses it:
/// "drives/joint1/limits/max_velocity (3.5)". `key`: below the drive's own.
std::string origin_of(const AxisParameters& parameters, const char* key, double value);
/// The same of both limits of position.
std::string position_limits_origin(const AxisParameters& parameters);

}  // namespace interpolated_motion::axis
