#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/motion/group.h"

namespace interpolated_motion::motion {

/// From when on the course can be changed, in its goal time; nothing where it cannot.
std::optional<GoalTime> Group::changeable_from() const {
  if (!plays_course() || (active_ && !active_->begin_is_set)) return std::nullopt;
  const auto until = committed(axes_);
  return until == axis::kEndCommitted ? std::nullopt : until;
}

/// The course stays as it is for `allowance` longer than it has to.
void Group::hold(GoalTime allowance) {
  for (axis::Axis* axis : axes_) axis->hold(*axis->committed() + allowance);
  holding_ = true;
}

GoalAcceptance Group::join(Planning& planning, HostTime now) {
  finish_goal({GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a newer goal."}});
  ActiveGoal next;
  next.id = next_goal_++;
  next.lead_in = planning.plan.lead_in;
  next.duration = planning.plan.duration;
  next.zero = planning.joining.join + next.lead_in;
  next.end = planning.end;
  next.tolerances =
      trajectory::merge_tolerances(parameters_.tolerances, parameters_.rules.joints, *planning.goal);
  next.begin_is_set = true;
  active_ = std::move(next);
  last_ = LastMotion{active_->id, active_->lead_in + active_->duration};
  in_force_since_ = std::max(in_force_since_, now - host_duration(kKept.count()));
  follow(std::move(planning.paths), std::move(planning.tails));
  enter(GroupState::Moving);
  return GoalAcceptance{active_->id, planning.end - axes_.front()->playback(now), planning.plan.warnings};
}

void Group::follow(std::vector<trajectory::Path> paths, std::vector<axis::TailPtr> tails) {
  course_.change(std::move(paths));
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i]->follow(std::move(tails[i]));
}

}  // namespace interpolated_motion::motion
