#include "interpolated_motion_driver/hardware/path_audit.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::hardware {

void PathAudit::begin(const trajectory::Path& path) {
  path_ = path;
  comparing_ = true;
  samples_ = 0;
  worst_ = 0.0;
  final_ = 0.0;
}

void PathAudit::add(double drive_seconds, double demand) {
  if (!comparing_) return;
  const GoalTime time = axis_->goal_time_at(drive_seconds);
  final_ = std::abs(demand - transmission_.counts(path_.sample(time).position));
  worst_ = std::max(worst_, final_);
  ++samples_;
}

}  // namespace interpolated_motion::hardware
