#pragma once

#include <optional>

#include "interpolated_motion_driver/motion/planning.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// Why a bus cannot carry the tails from rest, from goal time `start` on.
std::optional<Refusal> refuse_beyond_buses(const Planning& planning, GoalTime start);

/// The same of ways on, the present being goal time `now`: what the drives are to have by then has not been
/// loaded before.
std::optional<Refusal> refuse_way_on_beyond_buses(const Planning& planning, GoalTime now);

}  // namespace interpolated_motion::motion
