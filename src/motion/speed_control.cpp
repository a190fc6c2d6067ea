#include "interpolated_motion_driver/motion/speed_control.h"

#include <fmt/format.h>

namespace interpolated_motion::motion {

std::optional<Refusal> SpeedControl::take(const SpeedOrder& order) {
  const double rate = order.override_rate.value_or(override_);
  if (!(rate >= 0.0 && rate <= trajectory::kHighestRate)) {
    return Refusal{
        GoalError::InvalidGoal,
        fmt::format("The speed override is {:g}; allowed is 0 (a pause) to {:g}. It stays at {:g}.", rate,
                    trajectory::kHighestRate, override_)};
  }
  const bool paused = order.paused.value_or(paused_);
  if (rate != override_ || paused != paused_) ++orders_;
  override_ = rate;
  paused_ = paused;
  return std::nullopt;
}

std::string SpeedControl::take_oldest() {
  std::string note = std::move(notes_.front());
  notes_.pop_front();
  return note;
}

}  // namespace interpolated_motion::motion
