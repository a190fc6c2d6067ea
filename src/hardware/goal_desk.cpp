#include "interpolated_motion_driver/hardware/goal_desk.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::hardware {

namespace {

/// Least time that planning is allowed for a goal that joins: two turns between the threads.
constexpr double kLeastAllowance = 0.005;
/// Of what planning has taken lately, the multiple that the next one is allowed.
constexpr double kMargin = 2.0;
/// Longest that a goal is allowed at first, s: what is known is known from goals that may have been quite
/// different.
constexpr double kFirstAllowance = 1.0;
/// Planning a second of motion takes as long as planning so many points.
constexpr double kPointsInASecond = 50.0;
/// How often a goal is planned before it is given up; each time it is allowed twice as long.
constexpr int kAttempts = 6;

/// What planning a goal takes, as a number of points.
double size_of(const trajectory::Goal& goal) {
  return static_cast<double>(goal.points.size()) + kPointsInASecond * goal.points.back().time.count();
}

Refusal refusal_of(std::string text) { return {GoalError::InvalidGoal, std::move(text)}; }

}  // namespace

Ticket GoalDesk::submit(motion::GoalPtr goal, HostTime now) {
  const Ticket ticket = next_ticket_++;
  if (waiting_) answer(*std::exchange(waiting_, std::nullopt), refusal_of("Replaced by a newer goal."));
  Submission submission;
  submission.ticket = ticket;
  submission.goal = std::move(goal);
  if (!submission.goal->points.empty()) {
    submission.orders = group_.premises().orders;
    waiting_ = std::move(submission);
    poll(now);
    return ticket;
  }
  answer(submission, group_.submit(*submission.goal, now));
  return ticket;
}

void GoalDesk::withdraw(Ticket ticket) {
  const auto text = "Cancelled before it was planned.";
  if (waiting_ && waiting_->ticket == ticket)
    answer(*std::exchange(waiting_, std::nullopt), refusal_of(text));
  if (!current_ || current_->ticket != ticket || ticket == 0) return;
  answer(*current_, refusal_of(text));
  current_->ticket = 0;
  group_.drop_planning();
}

void GoalDesk::poll(HostTime now) {
  if (current_ && current_->done <= now) end_plan(now);
  while (!current_ && begin_next(now)) {
    if (current_ && current_->done <= now) end_plan(now);
  }
}

HostTime GoalDesk::next_deadline() const { return current_ ? current_->done : kNever; }

/// False when there is nothing to begin.
bool GoalDesk::begin_next(HostTime now) {
  auto planning = group_.may_plan() ? group_.take_planning(allowance_for_own(), now) : nullptr;
  if (planning) {
    current_ = Submission{};
    current_->planning = std::move(planning);
    run(now);
    return true;
  }
  if (!waiting_) return false;
  current_ = std::exchange(waiting_, std::nullopt);
  begin_plan(now);
  return true;
}

void GoalDesk::begin_plan(HostTime now) {
  if (current_->orders != group_.premises().orders) {
    answer(*current_, refusal_of("The group was stopped before the goal was planned. Send it again."));
    return current_.reset();
  }
  const GoalTime allowance = allowance_for(*current_);
  auto begun = current_->planning ? group_.renew(*current_->planning, allowance, now)
                                  : group_.begin(current_->goal, allowance, now);
  if (!begun) {
    answer(*current_, begun.error());
    return current_.reset();
  }
  current_->planning = std::move(begun.value());
  run(now);
}

void GoalDesk::run(HostTime now) {
  ++current_->attempts;
  if (planner_) return planner_(current_->planning);
  current_->planning->run();
  current_->done = now + planning_time_;
}

void GoalDesk::planned(const motion::Planning& planning, HostDuration taken, HostTime now) {
  if (!current_ || current_->planning.get() != &planning) return;
  last_planning_ = GoalTime{seconds(taken)};
  if (planning.goal) seconds_per_point_ = last_planning_.count() / std::max(1.0, size_of(*planning.goal));
  end_plan(now);
  poll(now);
}

void GoalDesk::end_plan(HostTime now) {
  motion::Planning& planning = *current_->planning;
  current_->done = kNever;
  if (current_->ticket == 0) {
    own_attempts_ = group_.end_own(planning, now) ? 0 : std::min(own_attempts_ + 1, kAttempts);
    return current_.reset();
  }
  auto answered = group_.end(planning, now);
  if (!answered && current_->attempts < kAttempts) return begin_plan(now);
  if (!answered) {
    answered = refusal_of(fmt::format(
        "What the arm does changed {} times while the goal was being planned. Send it again.", kAttempts));
  }
  const Submission submission = *std::exchange(current_, std::nullopt);
  answer(submission, std::move(*answered));
}

void GoalDesk::answer(const Submission& submission, Expected<motion::GoalAcceptance, Refusal> answer) {
  answers_.push_back({submission.ticket, submission.goal, std::move(answer)});
}

std::optional<GoalAnswer> GoalDesk::take_answer() {
  if (answers_.empty()) return std::nullopt;
  GoalAnswer answer = std::move(answers_.front());
  answers_.pop_front();
  return answer;
}

/// Of what the group has to plan: what was planned last may have been larger, or smaller.
GoalTime GoalDesk::allowance_for_own() const {
  if (!planner_ && planning_time_ == HostDuration{0}) return GoalTime{0.0};
  const double expected = planner_ ? kMargin * last_planning_.count() : seconds(planning_time_);
  return GoalTime{(std::min(expected, kFirstAllowance) + kLeastAllowance) *
                  static_cast<double>(1 << own_attempts_)};
}

GoalTime GoalDesk::allowance_for(const Submission& submission) const {
  if (!planner_ && planning_time_ == HostDuration{0}) return GoalTime{0.0};
  const double expected =
      planner_ ? kMargin * seconds_per_point_ * size_of(*submission.goal) : seconds(planning_time_);
  // Of a goal that has not been checked yet; it may have a time that is not a number.
  const double first = expected < kFirstAllowance ? std::max(expected, 0.0) : kFirstAllowance;
  return GoalTime{(first + kLeastAllowance) * static_cast<double>(1 << submission.attempts)};
}

}  // namespace interpolated_motion::hardware
