#include "interpolated_motion_driver/trajectory/shape_preserving.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::trajectory {

double shape_preserving_slope(double length_before, double slope_before, double length_after,
                              double slope_after) {
  const bool same_direction =
      (slope_before > 0.0 && slope_after > 0.0) || (slope_before < 0.0 && slope_after < 0.0);
  if (!same_direction) return 0.0;
  const double parabola =
      (slope_before * length_after + slope_after * length_before) / (length_before + length_after);
  const double limit = 2.0 * std::min(std::abs(slope_before), std::abs(slope_after));
  return std::copysign(std::min(std::abs(parabola), limit), slope_before);
}

}  // namespace interpolated_motion::trajectory
