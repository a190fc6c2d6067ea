#include "interpolated_motion_driver/hardware/path_audit.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::hardware {

void PathAudit::begin(const trajectory::Path& path, HostTime now) {
  path_ = path;
  begin_ = now;
  end_ = kNever;
  clear();
}

void PathAudit::follow(const trajectory::Path& path) { path_ = path; }

void PathAudit::end(HostTime now) { end_ = std::min(end_, now); }

void PathAudit::clear() {
  samples_ = 0;
  worst_ = 0.0;
  final_ = 0.0;
}

double PathAudit::count() const { return 1.0 / std::abs(mechanism_.counts_per_unit); }

void PathAudit::add(const DemandSample& sample) {
  if (sample.time < begin_ || sample.time > end_) return;
  const HostTime path_begin = host_time_ ? axis_->path_begin() : sample.time;
  if (path_begin == kNever) return;
  const GoalTime time =
      axis_->goal_time_at(host_time_ ? seconds(sample.time - path_begin) : sample.drive_seconds);
  final_ = std::abs(sample.demand - mechanism_.counts(path_.sample(time).position));
  worst_ = std::max(worst_, final_);
  ++samples_;
}

}  // namespace interpolated_motion::hardware
