#pragma once

#include "interpolated_motion_driver/hardware/configuration.h"
#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::hardware {

/// What the group of a configuration is held to: rules for goals, tolerances, patience.
motion::GroupParameters group_parameters(const Configuration& configuration);

}  // namespace interpolated_motion::hardware
