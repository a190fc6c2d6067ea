#include <algorithm>

#include <fmt/format.h>

#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::motion {

std::optional<Refusal> Group::setpoint(const Setpoint& setpoint, HostTime now) {
  auto refusal = take_setpoint(setpoint, now);
  ++(refusal ? setpoints_.refused : setpoints_.accepted);
  return refusal;
}

std::optional<Refusal> Group::take_setpoint(const Setpoint& setpoint, HostTime now) {
  if (auto refusal = refuse_now()) return refusal;
  if (state_ != GroupState::Idle && state_ != GroupState::Streaming)
    return Refusal{GoalError::InvalidGoal, "A goal is under way. Setpoints are taken when it has ended."};
  if (auto refusal = refuse_to_follow()) return refusal;
  if (state_ == GroupState::Idle) {
    std::vector<double> rest;
    for (const axis::Axis* axis : axes_) rest.push_back(axis->rest_position());
    stream_.begin(rest, now);
  }
  HostTime committed = now;
  for (const axis::Axis* axis : axes_) committed = std::max(committed, axis->committed());
  if (auto refusal = stream_.add(setpoint, committed, now)) return refusal;
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i]->follow(stream_.paths()[i], stream_.origin(), now);
  if (state_ == GroupState::Idle) {
    enter(GroupState::Streaming);
    in_force_since_ = now;
  }
  return std::nullopt;
}

std::optional<Refusal> Group::refuse_to_follow() const {
  for (const axis::Axis* axis : axes_) {
    if (axis->can_follow()) continue;
    return Refusal{
        GoalError::InvalidGoal,
        fmt::format("Joint \"{}\" takes whole trajectories only, since its drive plays from a FIFO: "
                    "setpoints need drives of type cyclic for all joints.",
                    axis->joint())};
  }
  return std::nullopt;
}

// The stream ends by itself: the path behind its last setpoint comes to rest.
void Group::poll_streaming(HostTime now) {
  if (const axis::Axis* axis = faulted()) return abort_with_fault_of(*axis, now);
  const auto at_rest = [](const axis::Axis* a) { return a->state() == axis::AxisState::Ready; };
  if (std::all_of(axes_.begin(), axes_.end(), at_rest)) enter_rest_state(now);
}

}  // namespace interpolated_motion::motion
