#pragma once

#include <limits>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion {

/// From `begin` to `end`. Where that is longer than a duration can tell (292 years), the longest of its sign:
/// for times that come from outside.
inline HostDuration span(HostTime begin, HostTime end) {
  HostDuration::rep length = 0;
  const bool overflows =
      __builtin_sub_overflow(end.time_since_epoch().count(), begin.time_since_epoch().count(), &length);
  if (!overflows) return HostDuration(length);
  return begin < end ? HostDuration::max() : HostDuration::min();
}

}  // namespace interpolated_motion
