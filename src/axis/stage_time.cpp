#include "interpolated_motion_driver/axis/stage_time.h"

namespace interpolated_motion::axis {

namespace {

/// Polls further apart than this mean that the host was away.
constexpr HostDuration kHostStall = std::chrono::milliseconds(100);

}  // namespace

HostDuration StageTime::poll(HostTime now) {
  const HostDuration passed = now - polled_;
  const HostDuration away = passed > kHostStall ? passed : HostDuration::zero();
  const bool within = polled_ >= since_;
  polled_ = now;
  if (away > HostDuration::zero()) returned_ = now;
  absent_ += away;
  if (!within) return HostDuration::zero();
  away_ += away;
  return away;
}

void StageTime::begin(HostTime now) {
  since_ = now;
  away_ = HostDuration::zero();
}

}  // namespace interpolated_motion::axis
