#include <memory>
#include <utility>

#include "interpolated_motion_driver/motion/group.h"

// What the group takes, and what it refuses as it is.
namespace interpolated_motion::motion {

Expected<GoalAcceptance, Refusal> Group::submit(const trajectory::Goal& goal, HostTime now) {
  const auto planning = begin(std::make_shared<const trajectory::Goal>(goal), GoalTime{0.0}, now);
  if (!planning) return planning.error();
  planning.value()->run();
  return *end(*planning.value(), now);  // nothing has happened in between
}

Expected<PlanningPtr, Refusal> Group::begin(GoalPtr goal, GoalTime allowance, HostTime now) {
  if (auto refusal = refuse_now()) return *refusal;
  return goals_.begin(std::move(goal), allowance, now);
}

Expected<PlanningPtr, Refusal> Group::renew(const Planning& stale, GoalTime allowance, HostTime now) {
  if (auto refusal = refuse_now()) return *refusal;
  return goals_.renew(stale, allowance, now);
}

std::optional<Expected<GoalAcceptance, Refusal>> Group::end(Planning& planning, HostTime now) {
  if (auto refusal = refuse_now()) {
    drop_planning();
    return *refusal;
  }
  return goals_.end(planning, now);
}

std::optional<Refusal> Group::setpoint(const Setpoint& setpoint, HostTime now) {
  auto refusal = refuse_now();
  if (!refusal) refusal = goals_.refuse_setpoints();
  if (!refusal) return stream_.take(setpoint, now);
  stream_.count_refused();
  return refusal;
}

std::optional<Refusal> Group::refuse_now() const {
  switch (drives_.state()) {
    case GroupState::Starting:
      return Refusal{
          GoalError::InvalidGoal,
          "The drives are still being found and configured. Send the goal again in a few seconds."};
    case GroupState::Disabled:
    case GroupState::Enabling:
      return Refusal{GoalError::InvalidGoal,
                     "The drives are not enabled. Call ~enable, then send the goal again."};
    case GroupState::Fault:
      return Refusal{GoalError::InvalidGoal, "The group is in fault: " + fault_};
    default:
      break;
  }
  if (power_off_ != PowerOff::No) return Refusal{GoalError::InvalidGoal, "The drives are being disabled."};
  return std::nullopt;
}

}  // namespace interpolated_motion::motion
