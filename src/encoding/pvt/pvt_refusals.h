#pragma once

#include <cstdint>

#include "interpolated_motion_driver/encoding/pvt/knot_search.h"
#include "interpolated_motion_driver/encoding/pvt/pvt_encoder.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/refusal.h"

namespace interpolated_motion::encoding {

/// The drive stands `deviation` counts off the path at the knot to continue from.
Refusal refuse_start(const trajectory::Path& path, const PvtEncoding& encoding, const PvtKnot& knot,
                     double deviation);

/// The path leaves the 32-bit position of a record at `sample`.
Refusal refuse_position(const trajectory::Path& path, const PvtEncoding& encoding, std::int64_t sample,
                        double counts);

/// The path leaves the 24-bit velocity of a record at `sample`; `units` in encoding.velocity_unit_rpm.
Refusal refuse_velocity(const trajectory::Path& path, const PvtEncoding& encoding, std::int64_t sample,
                        double units);

/// No record continues from search.dead_end(): finds out which rule stands in the way there, and by how much.
Refusal refuse_dead_end(const trajectory::Path& path, const PvtEncoding& encoding, const KnotSearch& search);

}  // namespace interpolated_motion::encoding
