#include "interpolated_motion_driver/motion/drives.h"

#include <algorithm>

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

bool holds_motion(axis::AxisState state) {
  return state == axis::AxisState::Loading || state == axis::AxisState::Loaded ||
         state == axis::AxisState::Moving;
}

}  // namespace

void Drives::enter(GroupState state) {
  state_ = state;
  ++states_;
  if (state == GroupState::Fault) in_force_since_ = kNever;
}

void Drives::enter_rest_state(HostTime now) {
  enter(all_are(axes_, axis::AxisState::Ready) ? GroupState::Idle : GroupState::Disabled);
  in_force_since_ = state_ == GroupState::Idle ? now : kNever;
}

bool Drives::plays_course() const {
  return state_ == GroupState::Moving || state_ == GroupState::Settling || state_ == GroupState::Streaming ||
         state_ == GroupState::Standing;
}

bool Drives::in_motion() const { return state_ == GroupState::Preparing || plays_course(); }

std::optional<GoalTime> Drives::changeable_from() const {
  if (!plays_course()) return std::nullopt;
  const auto until = committed(axes_);
  return until == axis::kEndCommitted ? std::nullopt : until;
}

bool Drives::ends_by_itself() const { return plays_course() && committed(axes_) == axis::kEndCommitted; }

void Drives::load(std::vector<axis::TailPtr> tails, HostTime now) {
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i]->load(std::move(tails[i]), now);
}

void Drives::begin(TimedPaths course, const LastMotion& motion, HostTime now) {
  course_.begin(std::move(course));
  last_ = motion;
  in_force_since_ = now;
}

void Drives::follow(TimedPaths course, std::vector<axis::TailPtr> tails, HostTime now) {
  in_force_since_ = std::max(in_force_since_, now - host_duration(kKept.count()));
  course_.change(std::move(course));
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i]->follow(std::move(tails[i]));
}

void Drives::hold(GoalTime allowance) {
  for (axis::Axis* axis : axes_) axis->hold(*axis->committed() + allowance);
}

void Drives::stop(HostTime now) {
  for (axis::Axis* axis : axes_) {
    if (holds_motion(axis->state())) axis->stop(now);
  }
  signal_all(signals_, now);
  enter(GroupState::Stopping);
}

trajectory::State Drives::desired(std::size_t joint, HostTime when) const {
  const axis::Axis& axis = *axes_[joint];
  if (plays_course()) return course_.paths()[joint].sample(axis.playback(when));
  return is_held(axis) ? without_acceleration(axis.rest_position(), 0.0) : as_it_goes(axis, when);
}

bool Drives::query(HostTime time, std::vector<trajectory::State>& out) const {
  if (time < in_force_since_) return false;
  out.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) out[i] = desired(i, time);
  return true;
}

}  // namespace interpolated_motion::motion
