#include "interpolated_motion_driver/axis/goal_timeline.h"

#include <algorithm>

namespace interpolated_motion::axis {

void GoalTimeline::begin(GoalTime at_zero) { stretches_.assign(1, {0.0, at_zero, 1.0}); }

void GoalTimeline::change_rate(double drive_seconds, double rate) {
  const GoalTime goal = at(drive_seconds);
  if (stretches_.back().rate == rate) return;
  if (stretches_.back().drive_begin == drive_seconds) stretches_.pop_back();
  stretches_.push_back({drive_seconds, goal, rate});
  if (stretches_.size() > kMemory) stretches_.pop_front();
}

GoalTime GoalTimeline::at(double drive_seconds) const {
  const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), drive_seconds,
                                      [](double t, const Stretch& s) { return t < s.drive_begin; });
  const Stretch& stretch = after == stretches_.begin() ? stretches_.front() : *(after - 1);
  return stretch.goal_begin + GoalTime{(drive_seconds - stretch.drive_begin) * stretch.rate};
}

}  // namespace interpolated_motion::axis
