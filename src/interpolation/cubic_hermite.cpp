#include "interpolated_motion_driver/interpolation/cubic_hermite.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::interpolation {

double CubicHermite::peak_velocity() const {
  double peak = std::max(std::abs(velocity(-duration_)), std::abs(velocity(0.0)));
  // velocity'(s) = 2 b + 6 a s vanishes at s = -b / (3 a). Compared before dividing, as a may be zero or
  // tiny.
  const double scale = a_ > 0 ? 3 * a_ : -3 * a_;
  const double scaled_vertex = a_ > 0 ? -b_ : b_;
  if (scaled_vertex < 0 && scaled_vertex > -scale * duration_) {
    peak = std::max(peak, std::abs(velocity(scaled_vertex / scale)));
  }
  return peak;
}

double CubicHermite::peak_acceleration() const {
  return std::max(std::abs(acceleration(-duration_)), std::abs(acceleration(0.0)));
}

}  // namespace interpolated_motion::interpolation
