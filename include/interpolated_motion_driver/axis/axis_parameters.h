#pragma once

#include <string>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// Settings of one drive that do not depend on its kind.
struct AxisParameters {
  std::string joint;                    ///< for joint() and messages
  encoding::Transmission transmission;  ///< between joint units and counts of the motor's encoder
  trajectory::JointLimits limits;       ///< velocity and acceleration must be finite
  double max_following_error = 0.1;     ///< rad or m, beyond it the drive faults (0x6065, ERL)
  HostDuration bring_up_timeout = std::chrono::seconds(5);  ///< longest wait for the first answer of a drive
};

}  // namespace interpolated_motion::axis
