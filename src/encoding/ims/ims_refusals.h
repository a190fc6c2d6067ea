#pragma once

#include "interpolated_motion_driver/encoding/ims/ims_encoding.h"
#include "interpolated_motion_driver/encoding/ims/ims_search.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::encoding {

/// The drive stands at `counts`, `deviation` counts off the path, at the knot to continue from.
Refusal refuse_start(const ImsEncoding& encoding, GoalTime time, double counts, double deviation);

/// `counts` is not a number, or beyond `most`, what the encoder can add up.
Refusal refuse_position(const ImsEncoding& encoding, GoalTime time, double counts, double most);

/// No segment continues from search.dead_end(): finds out which rule stands in the way there, and by how
/// much.
Refusal refuse_dead_end(const trajectory::Path& path, const ImsEncoding& encoding, ImsSearch& search);

}  // namespace interpolated_motion::encoding
