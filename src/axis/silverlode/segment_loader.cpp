#include "interpolated_motion_driver/axis/silverlode/segment_loader.h"

#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::axis {

namespace registers = silverlode::registers;

namespace {

/// Longest for one segment to get over the line before the motion.
constexpr HostDuration kFillTimeout = std::chrono::seconds(5);

}  // namespace

void SegmentLoader::begin(std::int32_t rest_counts, HostTime now) {
  rest_counts_ = rest_counts;
  cleared_ = false;
  auto steps = stage_.commands().require_no_fault();
  for (auto& step : delivery_.clear_steps()) steps.push_back(std::move(step));
  steps.push_back(stage_.commands().read(registers::kImsDeceleration, deceleration_));
  steps.push_back(stage_.commands().read(registers::kTargetPosition, target_));
  stage_.sequence().start(std::move(steps), now);
}

bool SegmentLoader::poll(HostTime now) {
  if (!cleared_) {
    poll_clearing(now);
    return false;
  }
  if (delivery_.delivered() == 1) return true;
  if (const auto failure = delivery_.offer(feed_.sent() == 0, 1.0, now)) {
    stage_.fail(*failure, now);
  } else if (stage_.time().expired(now, kFillTimeout)) {
    stage_.fail("its first segment does not get over the line: is the line overloaded or down?", now);
  }
  return false;
}

void SegmentLoader::poll_clearing(HostTime now) {
  if (!stage_.sequence_done(now)) return;
  if (deceleration_ != stage_.commands().underrun_deceleration()) {
    return stage_.go_offline(
        "the drive has restarted: register 19 is not as it was set, and its position may be lost too", now);
  }
  if (target_ != rest_counts_) {
    return stage_.fail(
        fmt::format("its target was {} counts when the goal was planned and is {} counts now: something else "
                    "moves this drive",
                    rest_counts_, target_),
        now);
  }
  cleared_ = true;
  stage_.time().begin(now);
}

}  // namespace interpolated_motion::axis
