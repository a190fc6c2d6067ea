#pragma once

#include <chrono>

#include "interpolated_motion_driver/motion/setpoint_path.h"
#include "interpolated_motion_driver/trajectory/goal_rules.h"
#include "interpolated_motion_driver/trajectory/tolerances.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

struct GroupParameters {
  trajectory::GoalRules rules;        ///< names, order and limits of the joints
  trajectory::Tolerances tolerances;  ///< where a goal has none of its own
  HostDuration settle_timeout =
      std::chrono::milliseconds(500);  ///< used where a goal allows no time for settling
  bool enable_on_start = true;         ///< once all drives are configured, without being asked
  StreamParameters stream;             ///< delays and patience with setpoints
  GoalTime speed_ramp{0.3};            ///< a change of the speed by 1 takes so long where the limits allow it
  /// A goal that is cancelled stops on its path, in so long where the limits allow it; 0: it stops as quickly
  /// as the drives brake, off its path.
  GoalTime stop_duration{0.0};
};

}  // namespace interpolated_motion::motion
