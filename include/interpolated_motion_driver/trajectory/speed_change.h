#pragma once

#include <optional>
#include <vector>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/time_law.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::trajectory {

/// How fast a motion is to be gone along, and how quickly that is reached.
struct Speed {
  double rate = 1.0;   ///< of the time law, 0 (stand still on the way) to `kHighestRate`
  GoalTime ramp{0.3};  ///< > 0: the rate changes by 1 in so long, where the limits allow that
};

inline constexpr double kHighestRate = 2.0;

/// The highest rate, at least 1, at which all joints keep their limits of velocity and acceleration on their
/// paths, those parts whose nominal time is behind `from`. The paths keep them at rate 1.
double highest_rate(const std::vector<Path>& nominal, GoalTime from, const std::vector<JointLimits>& limits);

/// A limit that a joint would leave.
struct SpeedViolation {
  std::size_t joint = 0;  ///< number of its path
  LimitViolation violation;
};

/// `law` until goal time `from`, and then to the rate of `speed`, or the highest that the limits allow behind
/// `from`, as soon as the ramp and the limits allow. The rate changes smoothly, in a ramp without a step of
/// slope but where the limits ask for one; where a joint has no acceleration left for the change, as one that
/// brakes with all it has, the change waits. Nothing of the motion is left: at once. Fails where no such ramp
/// keeps the limits, with the first violation.
Expected<TimeLaw, SpeedViolation> speed_changed(const TimeLaw& law, GoalTime from, const Speed& speed,
                                                const std::vector<Path>& nominal,
                                                const std::vector<JointLimits>& limits);

}  // namespace interpolated_motion::trajectory
