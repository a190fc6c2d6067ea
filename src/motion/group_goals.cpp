#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpolated_motion_driver/motion/bus_demands.h"
#include "interpolated_motion_driver/motion/group.h"
#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "interpolated_motion_driver/trajectory/goal_validation.h"

namespace interpolated_motion::motion {

namespace {

/// Of a goal that has to wait for rest. That its stamp goes by meanwhile, or that where the drives come to
/// rest by themselves is not known, is none of its sender's doing.
trajectory::GoalRules rules_of_waiting(trajectory::GoalRules rules, const trajectory::Goal& goal,
                                       bool sent_in_motion) {
  rules.join_late = rules.join_late || sent_in_motion || goal.start;
  rules.sent_in_motion = sent_in_motion;
  return rules;
}

/// Whether a goal that the drives do not follow may be tried again with an easier way to its first point, as
/// GoalRules::least_late of `later()`. A lead-in goes before the goal's time 0: it makes no point late.
bool may_be_later(const trajectory::GoalRules& rules, const trajectory::GoalPlan& plan) {
  constexpr GoalTime kMost{0.8};
  const bool can_be_easier = plan.bridge ? rules.join_late : plan.lead_in.count() > 0.0;
  return can_be_easier && rules.least_late < kMost;
}

trajectory::GoalRules later(trajectory::GoalRules rules) {
  constexpr GoalTime kFirst{0.1};
  rules.least_late = std::max(kFirst, 2.0 * rules.least_late);
  return rules;
}

}  // namespace

Expected<GoalAcceptance, Refusal> Group::submit(const trajectory::Goal& goal, HostTime now) {
  const auto& rules = parameters_.rules;
  if (auto refusal = trajectory::validate_goal(goal, rules.joints, rules.allow_partial_joints))
    return *refusal;
  if (auto refusal = refuse_now()) return *refusal;
  if (trajectory::is_stop_request(goal)) return accept_stop(now);
  if (auto refusal = trajectory::validate_stamp(goal, rules.max_start_ahead, now)) return *refusal;
  if (const auto committed = changeable_from()) return join(goal, *committed, now);
  if (state_ != GroupState::Idle) return replace_running(goal, now);
  auto planned = plan(goal, rules, rest_states(axes_), now);
  if (!planned) return planned.error();
  const GoalAcceptance acceptance{next_goal_++, planned.value().lead_in + planned.value().duration,
                                  planned.value().warnings};
  start_loading(acceptance.id, goal, std::move(planned.value()), now);
  return acceptance;
}

std::optional<Refusal> Group::refuse_now() const {
  switch (state_) {
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

// The drives have the end of their motion already, or none that could be changed: the goal begins from rest.
Expected<GoalAcceptance, Refusal> Group::replace_running(const trajectory::Goal& goal, HostTime now) {
  if (auto refusal = refuse_from_rest(goal, now)) return *refusal;
  if (pending_) fail_pending("replaced by a newer goal", GoalOutcome::Preempted);
  pending_ = PendingGoal{next_goal_++, goal, state_ == GroupState::Stopping};
  const bool ends = plays_course() && committed(axes_) == axis::kEndCommitted;
  if (in_motion() && !ends)
    stop(now, {GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a newer goal."}});
  return GoalAcceptance{pending_->id, goal.points.back().time, {}};
}

/// Where the group will rest is known unless it is being stopped; then it is the goal alone that can be
/// judged, from its own first point on.
std::optional<Refusal> Group::refuse_from_rest(const trajectory::Goal& goal, HostTime now) {
  const std::vector<std::string>& joints = parameters_.rules.joints;
  const bool ends = plays_course() && committed(axes_) == axis::kEndCommitted;
  std::vector<trajectory::State> rest = rest_states(axes_);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (ends) rest[i].position = course_.paths()[i].final_position();
    if (state_ != GroupState::Stopping) continue;
    const auto name = std::find(goal.joint_names.begin(), goal.joint_names.end(), joints[i]);
    if (name == goal.joint_names.end()) continue;
    rest[i].position =
        goal.points.front().positions[static_cast<std::size_t>(name - goal.joint_names.begin())];
  }
  const auto rules = rules_of_waiting(parameters_.rules, goal, state_ == GroupState::Stopping);
  const auto planned = plan(goal, rules, rest, now);
  if (!planned) return planned.error();
  return std::nullopt;
}

GoalAcceptance Group::accept_stop(HostTime now) {
  GoalAcceptance acceptance{next_goal_++, GoalTime{0.0}, {}};
  if (pending_) fail_pending("replaced by a stop", GoalOutcome::Preempted);
  if (in_motion()) stop(now, {GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a stop."}});
  stop_goals_.push_back(acceptance.id);
  if (state_ == GroupState::Idle) finish_stop_goals(GoalOutcome::Succeeded);
  return acceptance;
}

void Group::cancel(GoalId goal, HostTime now) {
  if (pending_ && pending_->id == goal) fail_pending("cancelled", GoalOutcome::Preempted);
  if (active_ && active_->id == goal && in_motion()) {
    stop(now, {GoalOutcome::Preempted, {GoalError::InvalidGoal, "Cancelled."}});
  }
}

std::optional<GoalResult> Group::take_goal_result() {
  if (results_.empty()) return std::nullopt;
  GoalResult result = std::move(results_.front());
  results_.pop_front();
  return result;
}

Expected<trajectory::GoalPlan, Refusal> Group::plan(const trajectory::Goal& goal,
                                                    const trajectory::GoalRules& rules,
                                                    const std::vector<trajectory::State>& rest,
                                                    HostTime now) {
  auto planned = trajectory::plan_goal(goal, rules, rest, now);
  if (!planned) return planned;
  const GoalTime wait = wait_after_signal(axes_);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto refusal = axes_[i]->plan(planned.value().paths[i], rest[i].position, wait);
    if (refusal && may_be_later(rules, planned.value())) return plan(goal, later(rules), rest, now);
    if (refusal) return *refusal;
  }
  if (auto refusal = refuse_beyond_buses(axes_, GoalTime{0.0} - planned.value().lead_in)) return *refusal;
  return planned;
}

void Group::start_loading(GoalId id, const trajectory::Goal& goal, trajectory::GoalPlan plan, HostTime now) {
  const HostTime start = goal.start ? *goal.start - host_duration(plan.lead_in.count()) : now;
  auto tolerances = trajectory::merge_tolerances(parameters_.tolerances, parameters_.rules.joints, goal);
  active_ = ActiveGoal{};
  active_->id = id;
  active_->tolerances = std::move(tolerances);
  active_->lead_in = plan.lead_in;
  active_->duration = plan.duration;
  active_->start = std::max(start, now);
  active_->paths = std::move(plan.paths);
  for (axis::Axis* axis : axes_) axis->load(now);
  enter(GroupState::Preparing);
}

void Group::start_pending(HostTime now) {
  const PendingGoal goal = *std::exchange(pending_, std::nullopt);
  const auto rules = rules_of_waiting(parameters_.rules, goal.goal, goal.sent_in_motion);
  auto planned = plan(goal.goal, rules, rest_states(axes_), now);
  if (planned) {
    const std::string remark = fmt::format("{}", fmt::join(planned.value().warnings, " "));
    start_loading(goal.id, goal.goal, std::move(planned.value()), now);
    active_->remark = remark;
    return;
  }
  results_.push_back(
      {goal.id, GoalOutcome::Aborted, planned.error().code,
       "The goal replaced another one, and from where the group came to rest it is not possible: " +
           planned.error().text});
}

void Group::start_motion(HostTime now) {
  for (axis::Axis* axis : axes_) {
    if (begins_at_signal(*axis)) axis->arm(now, now);
  }
  signal_all(now);
  in_force_since_ = now;
  set_common_begin(now);
  course_.begin(std::move(active_->paths));
  last_ = LastMotion{active_->id, active_->lead_in + active_->duration};
  enter(GroupState::Moving);
}

/// Tells the axes that need a lead when to begin: when those do that have got the start signal.
void Group::set_common_begin(HostTime now) {
  HostTime begin = now + host_duration(longest_lead(axes_).count());
  if (std::any_of(axes_.begin(), axes_.end(), [](const axis::Axis* a) { return begins_at_signal(*a); })) {
    begin = HostTime::min();
    for (const axis::Axis* axis : axes_) {
      if (begins_at_signal(*axis)) begin = std::max(begin, axis->path_begin());
    }
    if (begin == kNever) return;
  }
  for (axis::Axis* axis : axes_) {
    if (!begins_at_signal(*axis)) axis->arm(begin, now);
  }
  active_->begin_is_set = true;
}

void Group::finish_goal(const Ending& ending) {
  if (!active_) return;
  results_.push_back({active_->id, ending.outcome, ending.reason.code, ending.reason.text});
  active_.reset();
}

void Group::finish_stop_goals(GoalOutcome outcome, const std::string& why) {
  for (const GoalId id : stop_goals_) results_.push_back({id, outcome, GoalError::InvalidGoal, why});
  stop_goals_.clear();
}

void Group::fail_pending(const std::string& why, GoalOutcome outcome) {
  if (pending_) {
    results_.push_back(
        {pending_->id, outcome, GoalError::InvalidGoal, "The goal never started: " + why + "."});
    pending_.reset();
  }
}

}  // namespace interpolated_motion::motion
