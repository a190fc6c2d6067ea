#pragma once

#include <optional>
#include <vector>

#include "interpolated_motion_driver/encoding/transmission.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/trajectory/goal.h"

namespace interpolated_motion::axis {

/// The writes of a drive's own position limits (CiA 402, 607Dh) for a joint: two counts outside the joint's,
/// so that rounding never trips them; and as far out as the joint stands at `present` (rad), if that is known
/// and farther: a drive whose demand is outside faults, and then the joint could never be moved in again.
/// Without limits of the joint they are as wide as they can be.
std::vector<canopen::SdoWrite> position_limits(const trajectory::JointLimits& limits,
                                               const encoding::Transmission& transmission,
                                               std::optional<double> present);

}  // namespace interpolated_motion::axis
