#pragma once

#include <string>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/motion/axes.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// In fault or lost, and at rest for all that can be known.
bool is_out_of_order(const axis::Axis& axis);
/// The same, or its drive may still be on its way to rest.
bool is_faulted(const axis::Axis& axis);
/// The first one of those; null when there is none.
const axis::Axis* find_faulted(const Axes& axes);

/// Sentences about buses that carry nothing, each followed by a blank.
std::string bus_faults(const Signals& signals);
/// Why the group is in fault, and what to do.
std::string fault_text(const Axes& axes, const Signals& signals);

}  // namespace interpolated_motion::motion
