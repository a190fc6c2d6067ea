#pragma once

#include <vector>

#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/units/time.h"
#include "simulation/arm.h"
#include "simulation/script.h"

namespace interpolated_motion::simulation {

/// What makes a goal one that has to be refused, by itself and whatever the driver is doing: number `bad` of
/// the event.
enum class GoalDefect { None, BeyondLimit, StartElsewhere, EndsInMotion, NotANumber, UnknownJoint };

GoalDefect defect_of(const Event& event);

/// The goal of an event of verb `goal`, from where the joints stand (`present`, rad) to somewhere within
/// their limits: every joint along q(s) = q0 + A (10 s^3 - 15 s^4 + 6 s^5) + B (s - s^2)^3, so long that
/// velocity and acceleration take no more than the share `effort` of what is allowed. Its points are taken
/// from that curve.
trajectory::Goal make_goal(const Event& event, const Arm& arm, const std::vector<double>& present,
                           HostTime now);

/// A goal without points, which is a stop.
trajectory::Goal make_stop(const Arm& arm);

}  // namespace interpolated_motion::simulation
