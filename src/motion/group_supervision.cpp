#include <algorithm>

#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::motion {

namespace {

trajectory::State without_acceleration(double position, double velocity) { return {position, velocity, 0.0}; }

/// Longest that a joint is taken to go on as it did when it was heard last; after that it is where it was.
constexpr HostDuration kHeardLately = std::chrono::milliseconds(100);

/// A joint that brakes by itself, or that is not held: nobody demands anything else of it than what it does.
trajectory::State as_it_goes(const axis::Axis& axis, HostTime when) {
  const axis::AxisFeedback& feedback = axis.feedback();
  const HostDuration since = when - feedback.time;
  if (since > kHeardLately) return without_acceleration(feedback.position, 0.0);
  return without_acceleration(feedback.position + seconds(since) * feedback.velocity, feedback.velocity);
}

/// Whether the drive is held at its rest position: it is enabled and plays nothing.
bool is_held(const axis::Axis& axis) {
  switch (axis.state()) {
    case axis::AxisState::Ready:
    case axis::AxisState::Loading:
    case axis::AxisState::Loaded:
      return true;
    default:
      return false;
  }
}

}  // namespace

// Desired and actual states belong to the instant at which each drive latched its position, on that drive's
// own clock: a delay on the bus or a slow crystal is no error of the motion.
void Group::sample_feedback() {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const axis::AxisFeedback& feedback = axes_[i]->feedback();
    tracking_.actual[i] = without_acceleration(feedback.position, feedback.velocity);
    tracking_.desired[i] = desired(i, feedback.time);
    if (plays_course() && feedback.mean_over > HostDuration{}) {
      const double before = desired(i, feedback.time - feedback.mean_over).position;
      tracking_.desired[i].velocity = (tracking_.desired[i].position - before) / seconds(feedback.mean_over);
    }
  }
}

/// Of the tolerances at the goal's end, or on its path.
std::optional<Refusal> Group::find_violation(bool at_goal) {
  sample_feedback();
  const trajectory::Tolerances& tolerances = active_->tolerances;
  const auto violation = trajectory::find_tolerance_violation(at_goal ? tolerances.goal : tolerances.path,
                                                              tracking_.desired, tracking_.actual);
  if (!violation) return std::nullopt;
  const auto text = at_goal ? trajectory::goal_tolerance_violated : trajectory::path_tolerance_violated;
  return text(parameters_.rules.joints[violation->joint], parameters_.rules.limits[violation->joint].unit,
              *violation);
}

trajectory::State Group::desired(std::size_t joint, HostTime when) const {
  const axis::Axis& axis = *axes_[joint];
  if (plays_course()) return course_.paths()[joint].sample(axis.playback(when));
  return is_held(axis) ? without_acceleration(axis.rest_position(), 0.0) : as_it_goes(axis, when);
}

bool Group::query(HostTime time, std::vector<trajectory::State>& out) const {
  if (time < in_force_since_) return false;
  out.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) out[i] = desired(i, time);
  return true;
}

}  // namespace interpolated_motion::motion
