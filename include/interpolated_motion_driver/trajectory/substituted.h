#pragma once

#include "interpolated_motion_driver/trajectory/polynomial.h"

namespace interpolated_motion::trajectory {

/// q(t) = p(shift + rate * t), exact but for rounding. `shift` in s; `rate` in s of p's time per s of q's.
Polynomial substituted(const Polynomial& p, double shift, double rate);

}  // namespace interpolated_motion::trajectory
