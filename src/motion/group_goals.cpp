#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpolated_motion_driver/motion/begin_planning.h"
#include "interpolated_motion_driver/motion/group.h"
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

}  // namespace

Expected<GoalAcceptance, Refusal> Group::submit(const trajectory::Goal& goal, HostTime now) {
  const auto planning = begin(std::make_shared<const trajectory::Goal>(goal), GoalTime{0.0}, now);
  if (!planning) return planning.error();
  planning.value()->run();
  return *end(*planning.value(), now);  // nothing has happened in between
}

Expected<PlanningPtr, Refusal> Group::begin(GoalPtr goal, GoalTime allowance, HostTime now) {
  const auto& rules = parameters_.rules;
  if (auto refusal = refuse_now()) return *refusal;
  if (trajectory::is_stop_request(*goal)) {
    if (auto refusal = trajectory::validate_goal(*goal, rules.joints, rules.allow_partial_joints))
      return *refusal;
    auto planning = std::make_shared<Planning>();
    planning->entry = Planning::Entry::Stop;
    return planning;
  }
  if (auto refusal = trajectory::validate_stamp(*goal, rules.max_start_ahead, now)) return *refusal;
  if (allowance > GoalTime{0.0} && changeable_from()) hold(allowance);
  PlanningPtr planning = begin_now(std::move(goal), now);
  planning->premises = premises();
  return planning;
}

PlanningPtr Group::begin_now(GoalPtr goal, HostTime now) const {
  const auto& rules = parameters_.rules;
  if (const auto until = changeable_from())
    return planning_to_join(axes_, std::move(goal), rules, course_, *until, parameters_.stream.linger, now);
  if (state_ == GroupState::Idle)
    return planning_from_rest(axes_, std::move(goal), rules, rest_states(axes_), now);
  return begin_waiting(std::move(goal), now);
}

/// The drives have the end of their motion already, or none that could be changed: the goal begins from rest.
/// Where that will be is known unless the group is being stopped; then it is the goal alone that can be
/// judged, from its own first point on.
PlanningPtr Group::begin_waiting(GoalPtr goal, HostTime now) const {
  const bool stopping = state_ == GroupState::Stopping;
  std::vector<trajectory::State> rest = rest_states(axes_);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (ends_by_itself()) rest[i].position = course_.paths()[i].final_position();
    if (stopping) rest[i].position = first_position(*goal, parameters_.rules.joints[i], rest[i].position);
  }
  const auto rules = rules_of_waiting(parameters_.rules, *goal, stopping);
  PlanningPtr planning = planning_from_rest(axes_, std::move(goal), rules, rest, now);
  planning->entry = Planning::Entry::Wait;
  return planning;
}

Expected<PlanningPtr, Refusal> Group::renew(const Planning& stale, GoalTime allowance, HostTime now) {
  auto planning = begin(stale.goal, allowance, now);
  if (planning && stale.rules.sent_in_motion)
    planning.value()->rules = rules_of_waiting(parameters_.rules, *stale.goal, true);
  return planning;
}

std::optional<Expected<GoalAcceptance, Refusal>> Group::end(Planning& planning, HostTime now) {
  holding_ = false;
  if (auto refusal = refuse_now()) return *refusal;
  if (planning.entry == Planning::Entry::Stop) return accept_stop(now);
  if (planning.premises.orders != premises_.orders) {
    return Refusal{GoalError::InvalidGoal,
                   "The group was stopped while the goal was being planned. Send it again."};
  }
  if (!still_fits(planning)) return std::nullopt;
  if (planning.refusal) return *planning.refusal;
  if (planning.entry == Planning::Entry::Join) return join(planning, now);
  if (planning.entry == Planning::Entry::Wait) return wait_for_rest(planning, now);
  if (pending_) fail_pending("replaced by a newer goal", GoalOutcome::Preempted);
  const GoalAcceptance acceptance{next_goal_++, planning.plan.lead_in + planning.plan.duration,
                                  planning.plan.warnings};
  start_loading(acceptance.id, planning, now);
  return acceptance;
}

/// Whether the drives still rest, or move, as they did when planning began.
bool Group::still_fits(const Planning& planning) const {
  const Planning::Premises present = premises();
  if (planning.entry != Planning::Entry::Join) return planning.premises.states == present.states;
  if (!plays_course() || planning.premises.revision != present.revision) return false;
  for (std::size_t i = 0; i < planning.tails.size(); ++i) {
    if (!axes_[i]->can_follow(*planning.tails[i])) return false;
  }
  return true;
}

Planning::Premises Group::premises() const {
  Planning::Premises premises = premises_;
  premises.revision = course_.revision();
  return premises;
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

/// The drives have all of their motion, and it ends on the course.
bool Group::ends_by_itself() const { return plays_course() && committed(axes_) == axis::kEndCommitted; }

GoalAcceptance Group::wait_for_rest(const Planning& planning, HostTime now) {
  if (pending_) fail_pending("replaced by a newer goal", GoalOutcome::Preempted);
  pending_ = PendingGoal{next_goal_++, planning.goal, state_ == GroupState::Stopping, nullptr};
  if (in_motion() && !ends_by_itself())
    stop(now, {GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a newer goal."}});
  return GoalAcceptance{pending_->id, planning.goal->points.back().time, {}};
}

GoalAcceptance Group::accept_stop(HostTime now) {
  ++premises_.orders;
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

void Group::start_loading(GoalId id, Planning& planning, HostTime now) {
  const trajectory::Goal& goal = *planning.goal;
  trajectory::GoalPlan& plan = planning.plan;
  const HostTime start = goal.start ? *goal.start - host_duration(plan.lead_in.count()) : now;
  active_ = ActiveGoal{};
  active_->id = id;
  active_->tolerances = trajectory::merge_tolerances(parameters_.tolerances, parameters_.rules.joints, goal);
  active_->lead_in = plan.lead_in;
  active_->duration = plan.duration;
  active_->start = std::max(start, now);
  active_->set_out = active_->start - host_duration(head_start(axes_).count());
  active_->paths = std::move(plan.paths);
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i]->load(std::move(planning.tails[i]), now);
  enter(GroupState::Preparing);
}

PlanningPtr Group::take_planning(HostTime now) {
  if (!pending_ || state_ != GroupState::Idle || pending_->planning) return nullptr;
  auto rules = rules_of_waiting(parameters_.rules, *pending_->goal, pending_->sent_in_motion);
  rules.keep_last_point = true;
  pending_->planning = planning_from_rest(axes_, pending_->goal, rules, rest_states(axes_), now);
  pending_->planning->premises = premises();
  return pending_->planning;
}

void Group::end_waiting(Planning& planning, HostTime now) {
  if (!pending_ || pending_->planning.get() != &planning) return;
  if (!still_fits(planning)) return pending_->planning.reset();
  const GoalId id = pending_->id;
  pending_.reset();
  if (!planning.refusal) {
    start_loading(id, planning, now);
    active_->remark = fmt::format("{}", fmt::join(planning.plan.warnings, " "));
    return;
  }
  results_.push_back(
      {id, GoalOutcome::Aborted, planning.refusal->code,
       "The goal replaced another one, and from where the group came to rest it is not possible: " +
           planning.refusal->text});
}

void Group::start_motion(HostTime now) {
  for (axis::Axis* axis : axes_) {
    if (begins_at_signal(*axis)) axis->arm(now, now);
  }
  signal_all(signals_, now);
  in_force_since_ = now;
  set_common_begin(now);
  course_.begin(std::move(active_->paths));
  last_ = LastMotion{active_->id, active_->lead_in + active_->duration};
  enter(GroupState::Moving);
}

/// Tells the axes that need a lead when to begin: when those do that have got the start signal.
void Group::set_common_begin(HostTime now) {
  HostTime begin = std::max(active_->start, now + host_duration(longest_lead(axes_).count()));
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
