#include <algorithm>

#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::motion {

namespace {

trajectory::State without_acceleration(double position, double velocity) { return {position, velocity, 0.0}; }

}  // namespace

// Desired and actual states belong to the instant at which each drive latched its position, on that drive's
// own clock: a delay on the bus or a slow crystal is no error of the motion.
void Group::sample_feedback() {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const axis::AxisFeedback& feedback = axes_[i]->feedback();
    actual_[i] = without_acceleration(feedback.position, feedback.velocity);
    desired_[i] = desired(i, feedback.time);
  }
}

bool Group::feedback_since(HostTime when) const {
  return std::all_of(axes_.begin(), axes_.end(),
                     [when](const axis::Axis* a) { return a->feedback().time >= when; });
}

std::optional<Refusal> Group::find_path_violation() {
  sample_feedback();
  const auto violation = trajectory::find_tolerance_violation(active_->tolerances.path, desired_, actual_);
  if (!violation) return std::nullopt;
  const std::size_t joint = violation->joint;
  return trajectory::path_tolerance_violated(parameters_.rules.joints[joint],
                                             parameters_.rules.limits[joint].unit, *violation);
}

std::optional<Refusal> Group::find_goal_violation() {
  sample_feedback();
  const auto violation = trajectory::find_tolerance_violation(active_->tolerances.goal, desired_, actual_);
  if (!violation) return std::nullopt;
  const std::size_t joint = violation->joint;
  return trajectory::goal_tolerance_violated(parameters_.rules.joints[joint],
                                             parameters_.rules.limits[joint].unit, *violation);
}

HostTime Group::settle_deadline() const {
  if (!active_) return kNever;
  const HostDuration goal_time = host_duration(active_->tolerances.goal_time.count());
  return active_->ended + (goal_time > HostDuration::zero() ? goal_time : parameters_.settle_timeout);
}

trajectory::State Group::desired(std::size_t joint, HostTime when) const {
  const axis::Axis& axis = *axes_[joint];
  const trajectory::Path* path = path_in_force(joint);
  return path != nullptr ? path->sample(axis.playback(when))
                         : without_acceleration(axis.rest_position(), 0.0);
}

/// What the drive of a joint is playing; null at rest.
const trajectory::Path* Group::path_in_force(std::size_t joint) const {
  if (state_ == GroupState::Streaming) return &stream_.paths()[joint];
  const bool playing = state_ == GroupState::Moving || state_ == GroupState::Settling;
  return playing ? &active_->plan.paths[joint] : nullptr;
}

std::vector<trajectory::State> Group::present() const {
  std::vector<trajectory::State> states;
  for (const axis::Axis* axis : axes_) states.push_back(without_acceleration(axis->rest_position(), 0.0));
  return states;
}

bool Group::query(HostTime time, std::vector<trajectory::State>& out) const {
  if (time < in_force_since_) return false;
  out.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) out[i] = desired(i, time);
  return true;
}

}  // namespace interpolated_motion::motion
