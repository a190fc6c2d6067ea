#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"

#include "interpolated_motion_driver/encoding/setpoint_certificate.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/stop_path.h"

namespace interpolated_motion::axis {

void SetpointStream::rest(std::int32_t counts) { rest_ = counts; }

void SetpointStream::follow(const trajectory::Path& path, HostTime begin) {
  path_ = path;
  begin_ = begin;
  rest_.reset();
}

GoalTime SetpointStream::goal_time(HostTime when) const {
  return path_.start_time() + GoalTime{seconds(when - begin_)};
}

void SetpointStream::brake(const trajectory::JointLimits& limits) {
  if (rest_) return;
  const GoalTime now = goal_time(newest_);
  const trajectory::State state = path_.sample(now);
  trajectory::Path stop = trajectory::stop_path(state, now, limits);
  if (trajectory::find_position_violation(stop, limits))
    stop = trajectory::shortest_stop_path(state, now, limits);
  follow(stop, newest_);
}

std::optional<std::int32_t> SetpointStream::next(HostTime sync) {
  if (sync == kNever) return std::nullopt;
  const HostTime stamp = sync + period_;
  if (stamp <= newest_) return std::nullopt;
  const bool continues = newest_ != HostTime{};
  if (continues) missed_ += static_cast<std::uint64_t>((stamp - newest_ - period_ / 2) / period_);
  newest_ = stamp;
  counts_ = rest_ ? *rest_ : encoding::setpoint_at(path_, transmission_, goal_time(stamp));
  return counts_;
}

bool SetpointStream::played(HostTime now) const {
  const GoalTime duration = path_.end_time() - path_.start_time();
  const HostTime end = begin_ + host_duration(duration.count()) + order_ * period_;
  return rest_ || (newest_ >= end && now >= end);
}

}  // namespace interpolated_motion::axis
