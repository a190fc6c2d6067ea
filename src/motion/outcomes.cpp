#include "interpolated_motion_driver/motion/outcomes.h"

#include <utility>

namespace interpolated_motion::motion {

void Outcomes::end(GoalId goal, GoalOutcome outcome, Refusal reason) {
  results_.push_back({goal, outcome, reason.code, std::move(reason.text)});
}

void Outcomes::end_stops(GoalOutcome outcome, const std::string& why) {
  for (const GoalId goal : stops_) end(goal, outcome, {GoalError::InvalidGoal, why});
  stops_.clear();
}

std::optional<GoalResult> Outcomes::take() {
  if (results_.empty()) return std::nullopt;
  GoalResult result = std::move(results_.front());
  results_.pop_front();
  return result;
}

}  // namespace interpolated_motion::motion
