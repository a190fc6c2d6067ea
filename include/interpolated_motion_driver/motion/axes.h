#pragma once

#include <optional>
#include <vector>

#include "interpolated_motion_driver/axis/axis.h"
#include "interpolated_motion_driver/axis/start_signal.h"
#include "interpolated_motion_driver/axis/tail.h"
#include "interpolated_motion_driver/trajectory/path.h"
#include "interpolated_motion_driver/trajectory/polynomial.h"
#include "interpolated_motion_driver/units/expected.h"
#include "interpolated_motion_driver/units/refusal.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::motion {

/// What is asked of all axes of a group at once.
using Axes = std::vector<axis::Axis*>;
/// One of each bus.
using Signals = std::vector<axis::StartSignal*>;

/// Lets all drives obey at once.
void signal_all(const Signals& signals, HostTime now);

bool all_are(const Axes& axes, axis::AxisState state);
bool any_is(const Axes& axes, axis::AxisState state);

/// Where the drives' demands rest; see Axis::rest_position().
std::vector<trajectory::State> rest_states(const Axes& axes);
/// Whether each has reported a position that was latched at `when` or later.
bool have_reported_since(const Axes& axes, HostTime when);

/// The ways on of all axes along `paths`, or why one of them cannot follow its own.
Expected<std::vector<axis::TailPtr>, Refusal> encode_ways_on(const Axes& axes,
                                                             const std::vector<trajectory::Path>& paths,
                                                             axis::Pace pace);

/// Whether the axis begins a plan at the start signal of its bus; else it is told an instant.
bool begins_at_signal(const axis::Axis& axis);
/// The longest that any of them must be told beforehand when its path is to begin.
GoalTime longest_lead(const Axes& axes);
/// How long axes that begin at the signal rest after it, so that the others can be told the same instant.
GoalTime wait_after_signal(const Axes& axes);

/// From the start signal to the begin of the path; without axes that begin at it, from when they are told.
GoalTime head_start(const Axes& axes);

/// The longest that any is committed ahead in a stream.
GoalTime longest_stream_lead(const Axes& axes);

/// What lies further back than this behind the goal time that a drive plays is asked for by nobody: feedback
/// has reached the host by then.
inline constexpr GoalTime kKept{0.5};
/// Goal time of the drive that is behind all others.
GoalTime oldest_playback(const Axes& axes, HostTime now);

/// Until when the motion of any can no longer be changed, in the goal time of the course: infinite where one
/// of them has its end already; nothing where one has not begun.
std::optional<GoalTime> committed(const Axes& axes);

}  // namespace interpolated_motion::motion
