#pragma once

#include <optional>

#include "interpolated_motion_driver/encoding/setpoint_certificate.h"
#include "interpolated_motion_driver/interpolation/cip_polynomial.h"
#include "interpolated_motion_driver/trajectory/goal.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"

namespace interpolated_motion::axis {

/// Where a drive is that has gone on along its polynomial while target positions failed to come. Times are
/// those of the path that it is to follow.
struct Departure {
  trajectory::State state;  ///< of its demand at `start`
  GoalTime start{0.0};      ///< from here on it is led again
  GoalTime next{0.0};       ///< of its next target position: `start`, or a period later
  /// The target positions that it has, in the joint's units, the newest first.
  interpolation::CipKnots known{};
};

/// Largest acceleration, per s^2, of what the drive makes of target positions along `way_on` up to `until`.
double demand_acceleration(const Departure& from, const trajectory::Path& way_on, GoalTime until,
                           const encoding::SetpointEncoding& encoding);

/// The way of a drive back to `path`, in position, velocity and acceleration, and on along it: the shortest
/// of 6 periods and more that keeps 1.1 times the limits and is executed with an acceleration of the demand
/// within `encoding.max_acceleration`; if none is, the gentlest. It begins with the drive's position and
/// velocity, and with its acceleration where such a way is found. Its first piece is the way back. Nothing
/// where none of up to 50 periods keeps the limits (trajectory::rejoin): then the joint has to be stopped.
std::optional<trajectory::Path> way_back(const trajectory::Path& path, const Departure& from,
                                         const trajectory::JointLimits& limits,
                                         const encoding::SetpointEncoding& encoding);

}  // namespace interpolated_motion::axis
