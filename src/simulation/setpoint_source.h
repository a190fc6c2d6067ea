#pragma once

#include <deque>
#include <vector>

#include "interpolated_motion_driver/motion/setpoint.h"
#include "interpolated_motion_driver/units/time.h"
#include "simulation/arm.h"
#include "simulation/script.h"

namespace interpolated_motion::simulation {

/// A setpoint on its way to the driver.
struct SentSetpoint {
  HostTime arrives{};
  motion::Setpoint setpoint;
};

/// The setpoints of an event of verb `stream`: a sine of all joints from a crest where they stand (`present`,
/// rad), some of them lost, some late.
std::deque<SentSetpoint> make_stream(const Event& event, const Arm& arm, const std::vector<double>& present,
                                     HostTime now);

}  // namespace interpolated_motion::simulation
