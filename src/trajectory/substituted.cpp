#include "interpolated_motion_driver/trajectory/substituted.h"

#include <cstddef>

namespace interpolated_motion::trajectory {

// The Taylor coefficients of p at `shift`, by repeated Horner division, times powers of `rate`.
Polynomial substituted(const Polynomial& p, double shift, double rate) {
  auto c = p.coefficients;
  for (std::size_t low = 0; low + 1 < c.size(); ++low) {
    for (std::size_t i = c.size() - 1; i > low; --i) c[i - 1] += shift * c[i];
  }
  double power = 1.0;
  for (double& coefficient : c) {
    coefficient *= power;
    power *= rate;
  }
  return {c};
}

}  // namespace interpolated_motion::trajectory
