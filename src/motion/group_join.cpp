#include <algorithm>
#include <utility>

#include "interpolated_motion_driver/motion/bus_demands.h"
#include "interpolated_motion_driver/motion/group.h"
#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::motion {

namespace {

/// When a joint has come to rest for good, in the time of its path.
GoalTime rest_begin(const trajectory::Path& path) {
  const auto stands = [](const trajectory::Piece& piece) {
    const auto& c = piece.polynomial.coefficients;
    return std::all_of(c.begin() + 1, c.end(), [](double value) { return value == 0.0; });
  };
  const auto& pieces = path.pieces();
  const auto last = std::find_if_not(pieces.rbegin(), pieces.rend(), stands);
  return last == pieces.rend() ? path.start_time() : last->end;
}

}  // namespace

/// From when on the course can be changed, in its goal time; nothing where it cannot.
std::optional<GoalTime> Group::changeable_from() const {
  if (!plays_course() || (active_ && !active_->begin_is_set)) return std::nullopt;
  const auto until = committed(axes_);
  return until == axis::kEndCommitted ? std::nullopt : until;
}

/// Behind `committed`, or at the goal's stamp if that is later, the course becomes the goal's.
Expected<GoalAcceptance, Refusal> Group::join(const trajectory::Goal& goal, GoalTime committed,
                                              HostTime now) {
  const GoalTime present = axes_.front()->playback(now);
  const HostTime earliest = now + host_duration((committed - present).count());
  const HostTime when = goal.start ? std::max(earliest, *goal.start) : earliest;
  const GoalTime join = committed + GoalTime{seconds(when - earliest)};
  const auto plan = trajectory::plan_goal(goal, parameters_.rules, course_.at(join), when);
  if (!plan) return plan.error();

  ActiveGoal next;
  next.lead_in = plan.value().lead_in;
  next.duration = plan.value().duration;
  next.zero = join + next.lead_in;
  next.end = next.zero + next.duration;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!plan.value().named[i]) next.end = std::max(*next.end, rest_begin(course_.paths()[i]));
  }
  auto paths = course_with(plan.value(), join, *next.end, oldest_playback(axes_, now) - kKept);
  if (auto refusal = plan_way_on(axes_, paths, axis::Pace::Goal)) return *refusal;
  if (auto refusal = refuse_way_on_beyond_buses(axes_, present)) return *refusal;

  finish_goal({GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a newer goal."}});
  next.id = next_goal_++;
  next.tolerances = trajectory::merge_tolerances(parameters_.tolerances, parameters_.rules.joints, goal);
  next.begin_is_set = true;
  active_ = std::move(next);
  last_ = LastMotion{active_->id, active_->lead_in + active_->duration};
  in_force_since_ = std::max(in_force_since_, now - host_duration(kKept.count()));
  follow(std::move(paths));
  enter(GroupState::Moving);
  return GoalAcceptance{active_->id, *active_->end - present, plan.value().warnings};
}

/// All joints rest until the drives are to leave their interpolation, in one instant. Joints that the goal
/// does not name go on with what they did.
std::vector<trajectory::Path> Group::course_with(const trajectory::GoalPlan& plan, GoalTime join,
                                                 GoalTime end, GoalTime kept) const {
  const GoalTime leave = end + parameters_.stream.linger;
  std::vector<trajectory::Path> paths;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const trajectory::Path& former = course_.paths()[i];
    const trajectory::Path path =
        plan.named[i] ? course_.joined(i, kept, join, trajectory::shifted(plan.paths[i], join + plan.lead_in))
                      : former;
    paths.push_back(trajectory::splice(path, kept, leave, trajectory::Path(path.final_position())));
  }
  return paths;
}

void Group::follow(std::vector<trajectory::Path> paths) {
  course_.change(std::move(paths));
  for (axis::Axis* axis : axes_) axis->follow();
}

}  // namespace interpolated_motion::motion
