#include "simulation/invariants/orders_end_once.h"

#include <utility>

#include <fmt/format.h>

namespace interpolated_motion::simulation {

using motion::GoalOutcome;

void OrdersEndOnce::look(const Look& look) {
  if (ledger().is_dead()) return;
  const HostTime halted = std::exchange(halted_, kNever);
  if (halted != kNever && !is_at_rest(look.snapshot->state) && !ledger().has_order_since(halted))
    fail(fmt::format("a halt is answered while the group is {}", motion::to_string(look.snapshot->state)));
  for (const auto& [id, goal] : ledger().goals()) {
    if (!goal.result && look.now > goal.due)
      fail(fmt::format("goal {} has not ended {:.2f} s after it was accepted; the group is {}", id,
                       seconds(look.now - goal.accepted), motion::to_string(ledger().state())));
  }
  for (const auto& [id, request] : ledger().requests()) {
    // Power is on, or faults are reset, when the motion under way is over.
    if (!request.result && look.now > request.due && !ledger().has_open_goal() &&
        ledger().state() != motion::GroupState::Streaming)
      fail(fmt::format("request {} ({}) is not answered {:.2f} s after it was made; the group is {}", id,
                       request.verb, seconds(look.now - request.made), motion::to_string(ledger().state())));
  }
}

void OrdersEndOnce::goal_ended(const GoalEntry& goal) {
  const motion::GoalResult& result = *goal.result;
  if (result.outcome == GoalOutcome::Aborted && result.text.empty())
    fail(fmt::format("goal {} was aborted without a cause", result.id));
  if (result.outcome == GoalOutcome::Preempted && goal.ended_by.empty())
    fail(fmt::format("goal {} was preempted, and nobody has asked for that: {}", result.id, result.text));
}

void OrdersEndOnce::request_ended(const RequestEntry& request) {
  if (!request.result->success && request.result->message.empty())
    fail(fmt::format("{} has failed without a cause", request.verb));
  if (request.verb == "halt" && request.result->success) halted_ = request.made;
}

}  // namespace interpolated_motion::simulation
