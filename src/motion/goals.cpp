#include "interpolated_motion_driver/motion/goals.h"

#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpolated_motion_driver/motion/begin_planning.h"
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

Goals::Goals(const GroupParameters& parameters, Drives& drives)
    : parameters_(parameters),
      drives_(drives),
      speed_(parameters.speed_ramp),
      execution_(parameters, drives, speed_, outcomes_) {}

// Planning begins.

Expected<PlanningPtr, Refusal> Goals::begin(GoalPtr goal, GoalTime allowance, HostTime now) {
  const auto& rules = parameters_.rules;
  if (trajectory::is_stop_request(*goal)) {
    if (auto refusal = trajectory::validate_goal(*goal, rules.joints, rules.allow_partial_joints))
      return *refusal;
    auto planning = std::make_shared<Planning>();
    planning->entry = Planning::Entry::Stop;
    return planning;
  }
  if (auto refusal = trajectory::validate_stamp(*goal, rules.max_start_ahead, now)) return *refusal;
  if (allowance > GoalTime{0.0} && execution_.changeable_from()) hold(allowance);
  PlanningPtr planning = begin_now(std::move(goal), now);
  planning->premises = premises();
  return planning;
}

Expected<PlanningPtr, Refusal> Goals::renew(const Planning& stale, GoalTime allowance, HostTime now) {
  auto planning = begin(stale.goal, allowance, now);
  if (planning && stale.rules.sent_in_motion)
    planning.value()->rules = rules_of_waiting(parameters_.rules, *stale.goal, true);
  return planning;
}

/// The drives commit to so much more of what they do.
void Goals::hold(GoalTime allowance) {
  drives_.hold(allowance);
  holding_ = true;
}

PlanningPtr Goals::begin_now(GoalPtr goal, HostTime now) const {
  const auto& rules = parameters_.rules;
  if (const auto until = execution_.changeable_from())
    return planning_to_join(drives_.axes(), std::move(goal), rules, speed_.wanted(), drives_.course(), *until,
                            parameters_.stream.linger, now);
  if (drives_.state() == GroupState::Idle)
    return planning_from_rest(drives_.axes(), std::move(goal), rules, speed_.wanted(),
                              rest_states(drives_.axes()), now);
  return begin_waiting(std::move(goal), now);
}

/// The drives have the end of their motion already, or none that could be changed: the goal begins from rest.
/// Where that will be is known unless the group is being stopped; then it is the goal alone that can be
/// judged, from its own first point on.
PlanningPtr Goals::begin_waiting(GoalPtr goal, HostTime now) const {
  const bool stopping = drives_.state() == GroupState::Stopping;
  std::vector<trajectory::State> rest = rest_states(drives_.axes());
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (drives_.ends_by_itself()) rest[i].position = drives_.course().paths()[i].final_position();
    if (stopping) rest[i].position = first_position(*goal, parameters_.rules, i, rest[i].position);
  }
  const auto rules = rules_of_waiting(parameters_.rules, *goal, stopping);
  PlanningPtr planning =
      planning_from_rest(drives_.axes(), std::move(goal), rules, speed_.wanted(), rest, now);
  planning->entry = Planning::Entry::Wait;
  return planning;
}

Planning::Premises Goals::premises() const {
  Planning::Premises premises = premises_;
  premises.states = drives_.states();
  premises.revision = drives_.course().revision();
  premises.speeds = speed_.orders();
  return premises;
}

/// Whether the drives still rest, or move, as they did when planning began.
bool Goals::still_fits(const Planning& planning) const {
  if (planning.premises.revision != drives_.course().revision()) return false;
  if (planning.entry != Planning::Entry::Join) return planning.premises.states == drives_.states();
  if (!drives_.plays_course()) return false;
  for (std::size_t i = 0; i < planning.tails.size(); ++i) {
    if (!drives_.axes()[i]->can_follow(*planning.tails[i])) return false;
  }
  return true;
}

// Planning has ended.

std::optional<Expected<GoalAcceptance, Refusal>> Goals::end(Planning& planning, HostTime now) {
  holding_ = false;
  if (planning.entry == Planning::Entry::Stop) return accept_stop(now);
  if (planning.premises.orders != premises_.orders) {
    return Refusal{GoalError::InvalidGoal,
                   "The group was stopped while the goal was being planned. Send it again."};
  }
  if (!still_fits(planning)) return std::nullopt;
  if (planning.refusal) return *planning.refusal;
  if (planning.entry == Planning::Entry::Join) return join(planning, now);
  if (planning.entry == Planning::Entry::Wait) return wait_for_rest(planning, now);
  return start_from_rest(planning, now);
}

GoalAcceptance Goals::start_from_rest(Planning& planning, HostTime now) {
  fail_waiting("replaced by a newer goal", GoalOutcome::Preempted);
  execution_.finish(replaced_by_goal());
  GoalAcceptance acceptance{outcomes_.next(), planning.plan.lead_in + planning.plan.duration,
                            planning.plan.warnings};
  if (planning.is_paused()) {
    acceptance.warnings.emplace_back(
        "All motion is paused: the goal begins when ~resume has been called and the speed override is above "
        "0.");
  } else {
    acceptance.duration /= planning.course.law.final_rate();
  }
  execution_.begin(acceptance.id, planning, now);
  return acceptance;
}

GoalAcceptance Goals::join(Planning& planning, HostTime now) {
  execution_.finish(replaced_by_goal());
  const GoalId id = outcomes_.next();
  execution_.join(id, planning, now);
  const GoalTime end = drives_.course().law().when(planning.end).value_or(planning.end);
  return GoalAcceptance{id, end - drives_.axes().front()->playback(now), planning.plan.warnings};
}

GoalAcceptance Goals::wait_for_rest(const Planning& planning, HostTime now) {
  fail_waiting("replaced by a newer goal", GoalOutcome::Preempted);
  pending_ = PendingGoal{outcomes_.next(), planning.goal, drives_.state() == GroupState::Stopping, nullptr};
  if (drives_.in_motion() && !drives_.ends_by_itself()) execution_.stop(replaced_by_goal(), now);
  return GoalAcceptance{pending_->id, planning.goal->points.back().time, {}};
}

GoalAcceptance Goals::accept_stop(HostTime now) {
  count_order();
  GoalAcceptance acceptance{outcomes_.next(), GoalTime{0.0}, {}};
  fail_waiting("replaced by a stop", GoalOutcome::Preempted);
  end_active({GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a stop."}}, now);
  outcomes_.add_stop(acceptance.id);
  if (drives_.state() == GroupState::Idle) end_stops();
  return acceptance;
}

// What the group has to plan itself.

PlanningPtr Goals::take_planning(GoalTime allowance, HostTime now) {
  if (auto planning = take_waiting(now)) return planning;
  return begin_speed_wanted(allowance, now);
}

bool Goals::end_own(Planning& planning, HostTime now) {
  if (planning.goal) {
    end_waiting(planning, now);
    return true;
  }
  holding_ = false;
  const auto& active = execution_.active();
  if (!active || active->ending) return true;
  if (!still_fits(planning)) return false;
  take_speed(planning, now);
  return true;
}

PlanningPtr Goals::take_waiting(HostTime now) {
  if (!pending_ || drives_.state() != GroupState::Idle || pending_->planning) return nullptr;
  auto rules = rules_of_waiting(parameters_.rules, *pending_->goal, pending_->sent_in_motion);
  rules.keep_last_point = true;
  pending_->planning = planning_from_rest(drives_.axes(), pending_->goal, rules, speed_.wanted(),
                                          rest_states(drives_.axes()), now);
  pending_->planning->premises = premises();
  return pending_->planning;
}

void Goals::end_waiting(Planning& planning, HostTime now) {
  if (!pending_ || pending_->planning.get() != &planning) return;
  if (!still_fits(planning)) return pending_->planning.reset();
  const GoalId id = pending_->id;
  pending_.reset();
  execution_.finish(replaced_by_goal());
  if (!planning.refusal) {
    execution_.begin(id, planning, now);
    return execution_.remark(fmt::format("{}", fmt::join(planning.plan.warnings, " ")));
  }
  outcomes_.end(id, GoalOutcome::Aborted,
                {planning.refusal->code,
                 "The goal replaced another one, and from where the group came to rest it is not possible: " +
                     planning.refusal->text});
}

// How goals end from outside.

std::optional<Refusal> Goals::refuse_setpoints() const {
  if (speed_.is_paused()) {
    return Refusal{GoalError::InvalidGoal,
                   "All motion is paused. Setpoints are taken when ~resume has been called and the speed "
                   "override is above 0."};
  }
  if (holding_ || pending_ || (execution_.active() && drives_.state() == GroupState::Idle)) {
    return Refusal{GoalError::InvalidGoal,
                   "A goal is about to begin. Setpoints are taken when it has ended."};
  }
  return std::nullopt;
}

void Goals::cancel(GoalId goal, HostTime now) {
  if (pending_ && pending_->id == goal) fail_waiting("cancelled", GoalOutcome::Preempted);
  if (execution_.active() && execution_.active()->id == goal)
    end_active({GoalOutcome::Preempted, {GoalError::InvalidGoal, "Cancelled."}}, now);
}

/// By a stop, on the path if so configured; a goal that is paused, and stands, at once.
void Goals::end_active(const Ending& ending, HostTime now) {
  if (drives_.in_motion() && !stop_on_path(ending, now)) execution_.stop(ending, now);
  if (drives_.state() == GroupState::Idle) execution_.finish(ending);
}

void Goals::halt(const std::string& why, const Ending& ending, HostTime now) {
  count_order();
  fail_waiting(why);
  if (drives_.in_motion()) execution_.stop(ending, now);
  if (drives_.state() == GroupState::Idle) execution_.finish(ending);
}

void Goals::fail(const std::string& fault) {
  fail_waiting(fault);
  outcomes_.end_stops(GoalOutcome::Aborted, fault);
  execution_.finish({GoalOutcome::Aborted, {GoalError::InvalidGoal, fault}});
}

void Goals::fail_waiting(const std::string& why, GoalOutcome outcome) {
  if (!pending_) return;
  outcomes_.end(pending_->id, outcome, {GoalError::InvalidGoal, "The goal never started: " + why + "."});
  pending_.reset();
}

}  // namespace interpolated_motion::motion
