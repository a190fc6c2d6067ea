#include "simulation/invariants/accepted_is_held.h"

#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

using motion::GoalOutcome;

namespace {

/// Counts beyond the deviation bound: the last point and the axis are rounded to counts, and a servo at rest
/// may be off by one.
constexpr double kRounding = 3.0;

}  // namespace

void AcceptedIsHeld::check_outcome(const GoalEntry& goal) {
  const motion::GoalResult& result = *goal.result;
  if (result.outcome == GoalOutcome::Aborted && goal.ended_by.empty())
    fail(fmt::format("goal {} was aborted though nothing went wrong: {}", result.id, result.text));
}

void AcceptedIsHeld::goal_ended(const GoalEntry& goal) {
  if (ledger().is_disturbed()) return;
  check_outcome(goal);
  look_at_end_ = goal.result->outcome == GoalOutcome::Succeeded && !goal.is_stop;
  ended_ = goal;
}

void AcceptedIsHeld::look(const Look& look) {
  const bool look_at_end = std::exchange(look_at_end_, false);
  if (ledger().is_disturbed()) return;
  if (look.snapshot->state == motion::GroupState::Fault)
    fail("the group is in fault though nothing went wrong: " + look.snapshot->fault);
  const motion::GroupState state = look.snapshot->state;
  if (!look_at_end || (state != motion::GroupState::Idle && state != motion::GroupState::Standing)) return;
  for (const auto& [index, target] : ended_.target) {
    const Joint& joint = arm().joints[index];
    const double off = ((*look.positions)[index] - target) / joint.count();
    // Drives that are still under way come nearer as the last of their records are played.
    const double bound = state == motion::GroupState::Standing ? joint.joining_bound : joint.deviation_bound;
    if (std::abs(off) > bound + kRounding)
      fail(fmt::format("{} stands {:.1f} counts beside the last point of goal {}, which has succeeded",
                       joint.label(), off, ended_.result->id));
  }
}

}  // namespace interpolated_motion::simulation
