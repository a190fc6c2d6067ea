#pragma once

#include <optional>

#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/encoding/setpoint_certificate.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::axis {

/// A path whose target positions a cyclic drive can follow, from rest or behind the newest one. It has no
/// slots: target positions go to the bus at rest as well, so nothing adds to what the bus carries.
struct SetpointTail : Tail {
  trajectory::Path path;           ///< rad or m over goal time
  std::optional<HostTime> origin;  ///< from rest: host time of goal time 0, for a stream
  GoalTime from{0.0};              ///< behind what is committed: where that ends
};

/// Of goals from rest: executes all target positions as the drive will.
TailEncoderPtr setpoint_goal_encoder(const encoding::SetpointEncoding& encoding);

/// Of goals behind `from`, the instant of a target position in goal time. What the drive makes of it depends
/// on a few before it: those have been held against the former way.
TailEncoderPtr setpoint_way_on_encoder(const encoding::SetpointEncoding& encoding, GoalTime from);

/// Of setpoints behind `from`, whose limits are judged as they are laid (Axis::demand_check()): here how far
/// the drive would be off the path.
TailEncoderPtr setpoint_stream_encoder(const encoding::SetpointEncoding& encoding, GoalTime from);

}  // namespace interpolated_motion::axis
