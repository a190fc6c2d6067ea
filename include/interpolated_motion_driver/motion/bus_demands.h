#pragma once

#include <optional>

#include "interpolated_motion_driver/motion/axes.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// Why a bus cannot carry what the axes have planned last (Axis::plan()), from goal time `start` on.
std::optional<Refusal> refuse_beyond_buses(const Axes& axes, GoalTime start);

/// The same of the way on that they have planned last (Axis::plan_follow()), the present being goal time
/// `now`: what the drives are to have by then has not been loaded before.
std::optional<Refusal> refuse_way_on_beyond_buses(const Axes& axes, GoalTime now);

}  // namespace interpolated_motion::motion
