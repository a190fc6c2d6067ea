#include <fmt/format.h>

#include "interpolated_motion_driver/motion/begin_planning.h"
#include "interpolated_motion_driver/motion/goals.h"

// How fast the active goal is gone along: override, pause, stop on its path.
namespace interpolated_motion::motion {

namespace {

/// A rate that is less than what was wished for by no more than this is it.
constexpr double kRounding = 1e-9;

}  // namespace

std::optional<Refusal> Goals::order_speed(const SpeedOrder& order, HostTime now) {
  if (auto refusal = speed_.take(order)) return refusal;
  if (!speed_.is_paused()) return std::nullopt;
  const PlanningPtr pause = begin_speed_wanted(GoalTime{0.0}, now);
  if (!pause) return std::nullopt;
  pause->run();
  end_own(*pause, now);  // nothing has happened in between
  return pause->refusal;
}

PlanningPtr Goals::begin_speed_wanted(GoalTime allowance, HostTime now) {
  const auto& active = execution_.active();
  const bool is_due = active && !active->ending && active->speeds != speed_.orders();
  if (!is_due || (drives_.state() == GroupState::Moving && refused_ == speed_.orders())) return nullptr;
  return begin_speed(speed_.wanted(), allowance, now);
}

/// The active goal at another speed; null while that cannot be, or need not.
PlanningPtr Goals::begin_speed(const trajectory::Speed& speed, GoalTime allowance, HostTime now) {
  const ActiveGoal& active = *execution_.active();
  PlanningPtr planning;
  if (drives_.state() == GroupState::Idle && speed.rate > 0.0) {
    planning = planning_to_resume(drives_.axes(), parameters_.rules, speed, active, now);
  } else if (drives_.state() == GroupState::Moving) {
    if (allowance > GoalTime{0.0} && execution_.changeable_from()) hold(allowance);
    const auto until = execution_.changeable_from();
    if (!until) {  // they have all of it up to its end, or to a pause
      holding_ = false;
      return nullptr;
    }
    planning = planning_of_speed(drives_.axes(), parameters_.rules, speed, drives_.course(), *until,
                                 active.end, parameters_.stream.linger, now);
  } else {
    return nullptr;
  }
  planning->premises = premises();
  return planning;
}

void Goals::take_speed(Planning& planning, HostTime now) {
  if (planning.refusal) return refuse_speed(planning);
  const double rate = planning.course.law.final_rate();
  if (rate < planning.speed.rate - kRounding) {
    speed_.note(
        fmt::format("The limits of the joints allow a speed of {:.3g} for the rest of the goal, not {:g}.",
                    rate, planning.speed.rate));
  }
  execution_.go_on(planning, now);
}

/// A goal that cannot go on from where it stands is over. One that comes to stand goes on from there.
void Goals::refuse_speed(const Planning& planning) {
  const Refusal& refusal = *planning.refusal;
  if (drives_.state() == GroupState::Idle) {
    return execution_.finish(
        {GoalOutcome::Aborted, {refusal.code, "The goal cannot go on: " + refusal.text}});
  }
  refused_ = planning.premises.speeds;
  if (drives_.course().law().final_rate() == 0.0) return;
  execution_.stay(planning);
  speed_.note(refusal.text + " The goal goes on as it did.");
}

/// False where that is not wished for, or cannot be: nothing has changed then.
bool Goals::stop_on_path(const Ending& ending, HostTime now) {
  const auto& active = execution_.active();
  if (parameters_.stop_duration <= GoalTime{0.0} || !active) return false;
  if (active->ending) return true;
  const PlanningPtr stop = begin_speed({0.0, parameters_.stop_duration}, GoalTime{0.0}, now);
  if (!stop || stop->entry != Planning::Entry::Join) return false;
  stop->run();
  if (stop->refusal) return false;
  count_order();
  execution_.go_on(*stop, now);
  execution_.end_on_path(ending);
  return true;
}

}  // namespace interpolated_motion::motion
