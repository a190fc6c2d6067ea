#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "interpolated_motion_driver/encoding/ims/ims_encoder.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// The bound that holds from an instant on.
struct BoundFrom {
  GoalTime time{0.0};
  double counts = 0.0;
};

/// How a path is met from a knot that is not on it, or not as fast as it.
struct ImsApproach {
  double bound = 0.0;               ///< counts, from the knot on
  std::deque<BoundFrom> bounds;     ///< what holds later, in the order of time
  std::vector<std::int64_t> ticks;  ///< of all segments to the end of the path, at rate 1
};

/// Bounds for a way on: `encoding.bound_counts` or as many doublings of it as it takes, from `first` on and
/// at most `widest`, are tried from `from` to the end of `path`, which is reached in rest. Refused when there
/// is none.
Expected<ImsApproach, Refusal> plan_ims_way_on(const trajectory::Path& path,
                                               const encoding::ImsEncoding& encoding,
                                               const encoding::ImsKnot& from, double first, double widest);

/// The same for a path worth following closely: behind the knot the bound is halved again, segment by
/// segment, as soon as that is possible, down to `encoding.bound_counts`.
Expected<ImsApproach, Refusal> plan_ims_approach(const trajectory::Path& path,
                                                 const encoding::ImsEncoding& encoding,
                                                 const encoding::ImsKnot& from, double first, double widest);

}  // namespace interpolated_motion::axis
