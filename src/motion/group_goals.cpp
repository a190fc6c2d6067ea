#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/motion/bus_budget.h"
#include "interpolated_motion_driver/motion/group.h"
#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "interpolated_motion_driver/trajectory/goal_validation.h"

namespace interpolated_motion::motion {

namespace {

/// Longest from the start signal to the host's knowing when it was on the bus, a stall of the host included.
constexpr GoalTime kSignalAllowance{0.1};

bool begins_at_signal(const axis::Axis& axis) { return axis.start_lead() == GoalTime{0.0}; }

/// What a bus can carry: as far as its share for records goes, or beside the questions to its drives.
std::string capacity_text(const MissedDeadline& missed, const BusDemand& demand) {
  if (missed.looks == 0.0)
    return fmt::format("its share for records allows {:.0f} a second", 1.0 / demand.record_bus_time);
  return fmt::format(
      "beside the questions to its drives, which take {:.0f} % of it, it carries {:.0f} a second",
      1e2 * missed.looks, std::max(0.0, 1.0 - missed.looks) / demand.watch.record_time);
}

}  // namespace

Expected<GoalAcceptance, Refusal> Group::submit(const trajectory::Goal& goal, HostTime now) {
  const auto& rules = parameters_.rules;
  if (auto refusal = trajectory::validate_goal(goal, rules.joints, rules.allow_partial_joints))
    return *refusal;
  if (auto refusal = refuse_now()) return *refusal;
  if (trajectory::is_stop_request(goal)) return accept_stop(now);
  if (auto refusal = trajectory::validate_stamp(goal, rules.max_start_ahead, now)) return *refusal;
  if (state_ != GroupState::Idle) return replace_running(goal, now);
  auto planned = plan(goal, now);
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

// The new goal is checked against where the group comes to rest, once it is there.
Expected<GoalAcceptance, Refusal> Group::replace_running(const trajectory::Goal& goal, HostTime now) {
  if (pending_) fail_pending("replaced by a newer goal", GoalOutcome::Preempted);
  pending_ = PendingGoal{next_goal_++, goal};
  if (in_motion()) stop(now, {GoalOutcome::Preempted, {GoalError::InvalidGoal, "Replaced by a newer goal."}});
  return GoalAcceptance{pending_->id, goal.points.back().time, {}};
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

Expected<trajectory::GoalPlan, Refusal> Group::plan(const trajectory::Goal& goal, HostTime now) {
  auto planned = trajectory::plan_goal(goal, parameters_.rules, present(), now);
  if (!planned) return planned;
  if (auto refusal = plan_axes(planned.value())) return *refusal;
  if (auto refusal = check_budget(planned.value())) return *refusal;
  return planned;
}

std::optional<Refusal> Group::plan_axes(const trajectory::GoalPlan& plan) {
  const GoalTime wait = wait_after_signal();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (auto refusal = axes_[i]->plan(plan.paths[i], wait)) return refusal;
  }
  return std::nullopt;
}

std::optional<Refusal> Group::check_budget(const trajectory::GoalPlan& plan) const {
  std::map<std::string, std::vector<BusDemand>> demands;
  for (const axis::Axis* axis : axes_)
    demands[axis->bus()].push_back({axis->record_slots(), axis->record_bus_time(), axis->bus_watch()});
  for (const auto& [bus, demand] : demands) {
    const auto missed = check_bus_budget(demand, GoalTime{0.0} - plan.lead_in);
    if (!missed) continue;
    return Refusal{
        GoalError::InvalidGoal,
        fmt::format(
            "Bus {} cannot carry the goal: at {:.3f} s a record would come {:.0f} ms too late; it needs "
            "{:.0f} records in the second before, and {}. Slow the goal down, use smoother points, raise the "
            "bit rate, or put the drives on more buses.",
            bus, missed->time.count(), std::ceil(1e3 * missed->late.count()), missed->needed,
            capacity_text(*missed, demand.front()))};
  }
  return std::nullopt;
}

void Group::start_loading(GoalId id, const trajectory::Goal& goal, trajectory::GoalPlan plan, HostTime now) {
  const HostTime start = goal.start ? *goal.start - host_duration(plan.lead_in.count()) : now;
  auto tolerances = trajectory::merge_tolerances(parameters_.tolerances, parameters_.rules.joints, goal);
  active_ = ActiveGoal{id, std::move(plan), std::move(tolerances), std::max(start, now)};
  for (axis::Axis* axis : axes_) axis->load(now);
  enter(GroupState::Preparing);
}

void Group::start_pending(HostTime now) {
  const PendingGoal goal = *std::exchange(pending_, std::nullopt);
  auto planned = plan(goal.goal, now);
  if (planned) return start_loading(goal.id, goal.goal, std::move(planned.value()), now);
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
  active_->started = now;
  in_force_since_ = now;
  set_common_begin(now);
  last_ = active_;
  last_is_stream_ = false;
  enter(GroupState::Moving);
}

/// Tells the axes that need a lead when to begin: when those do that have got the start signal.
void Group::set_common_begin(HostTime now) {
  HostTime begin = now + host_duration(longest_lead().count());
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

GoalTime Group::longest_lead() const {
  GoalTime longest{0.0};
  for (const axis::Axis* axis : axes_) longest = std::max(longest, axis->start_lead());
  return longest;
}

GoalTime Group::wait_after_signal() const {
  const GoalTime lead = longest_lead();
  return lead > GoalTime{0.0} ? lead + kSignalAllowance : lead;
}

void Group::finish_goal(const Ending& ending) {
  if (!active_) return;
  results_.push_back({active_->id, ending.outcome, ending.reason.code, ending.reason.text});
  if (last_ && last_->id == active_->id) last_ = active_;
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
