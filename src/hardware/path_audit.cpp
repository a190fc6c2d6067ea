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

void PathAudit::add(const emulation::EposSample& sample) {
  if (!comparing_ || !sample.interpolating) return;
  const GoalTime time = path_.start_time() + GoalTime{static_cast<double>(sample.samples_since_start) * 1e-3};
  final_ = std::abs(sample.demand - transmission_.counts(path_.sample(time).position));
  worst_ = std::max(worst_, final_);
  ++samples_;
}

}  // namespace interpolated_motion::hardware
