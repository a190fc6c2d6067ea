#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"

#include <algorithm>
#include <limits>

#include "interpolated_motion_driver/trajectory/jerk_limited_stop.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "interpolated_motion_driver/trajectory/rejoin.h"
#include "interpolated_motion_driver/trajectory/stop_path.h"
#include "interpolated_motion_driver/trajectory/stream_path.h"

namespace interpolated_motion::axis {

namespace {

/// Periods in which the acceleration of a stop is ramped up. A step of acceleration between two target
/// positions is one of velocity, a sixth of it times the period, in what the drive makes of them: the longer,
/// the smoother.
constexpr int kRamps[] = {3, 4, 5, 6, 8, 10, 12};
/// Of the limit, for a stop: the drive's polynomials go beyond the acceleration they are laid through.
constexpr double kBrakingShare = 0.9;
/// Of the limits, for the way back to the path.
constexpr double kComeBackMargin = 1.1;
/// Periods, the way back to the path: fewer are a jerk, and with more the joint is not where it is thought to
/// be.
constexpr int kShortestComeBack = 6;
constexpr int kLongestComeBack = 50;

/// How a stop that begins at `start`, with `before` in front of it, is made for a drive.
class StopSearch {
 public:
  StopSearch(const encoding::SetpointEncoding& encoding, const trajectory::JointLimits& limits,
             const trajectory::Path& before, GoalTime start)
      : encoding_(encoding), limits_(limits), before_(before), start_(start) {}

  /// The shortest of which the drive's demand keeps the limit of acceleration; else the smoothest for which
  /// there is room; else the shortest of all.
  trajectory::Path stop(const trajectory::State& from) const {
    std::optional<trajectory::Path> best;
    double least = std::numeric_limits<double>::infinity();
    for (const int periods : kRamps) {
      const trajectory::Path candidate = trajectory::jerk_limited_stop(
          from, start_, {kBrakingShare * limits_.max_acceleration, periods * encoding_.period});
      if (trajectory::find_position_violation(candidate, limits_)) break;
      const double acceleration = demand(candidate);
      if (acceleration >= least) continue;
      best = candidate;
      least = acceleration;
      if (acceleration <= limits_.max_acceleration) break;
    }
    return best ? *best : trajectory::shortest_stop_path(from, start_, limits_);
  }

 private:
  double demand(const trajectory::Path& stop) const {
    const GoalTime first = start_ - static_cast<double>(interpolation::kCipHistory) * encoding_.period;
    return encoding::demand_acceleration(trajectory::splice(before_, first, start_, stop), first, encoding_);
  }

  const encoding::SetpointEncoding& encoding_;
  const trajectory::JointLimits& limits_;
  const trajectory::Path& before_;
  GoalTime start_;
};

/// What a joint has come along that goes on evenly as it is: there is no path behind a drive that went
/// astray.
trajectory::Path even(const trajectory::State& state, GoalTime end, GoalTime period) {
  const GoalTime start = end - 4.0 * interpolation::kCipHistory * period;
  const double t = (end - start).count();
  const double velocity = state.velocity - state.acceleration * t;
  const double position = state.position - t * (velocity + 0.5 * state.acceleration * t);
  return trajectory::Path({{start, end, {{position, velocity, 0.5 * state.acceleration, 0.0, 0.0, 0.0}}}});
}

}  // namespace

SetpointStream::SetpointStream(const encoding::SetpointEncoding& encoding,
                               const trajectory::JointLimits& limits)
    : encoding_(encoding),
      limits_(limits),
      period_(host_duration(encoding.period.count())),
      history_(encoding.order, period_) {}

void SetpointStream::rest(std::int32_t counts) {
  rest_ = counts;
  astray_ = false;
  back_at_ = HostTime{};
}

void SetpointStream::follow(const trajectory::Path& path, HostTime begin) {
  const trajectory::State there = path_.sample(goal_time(newest()));
  braking_ = false;
  lay(path, begin);
  if (newest() < back_at_) bridge(there, newest());
}

void SetpointStream::lay(const trajectory::Path& path, HostTime begin) {
  path_ = path;
  begin_ = begin;
  rest_.reset();
}

GoalTime SetpointStream::goal_time(HostTime when) const {
  return path_.start_time() + GoalTime{seconds(when - begin_)};
}

bool SetpointStream::rests_at(GoalTime time) const {
  return time <= path_.start_time() || time >= path_.end_time();
}

void SetpointStream::brake() {
  if (rest_) return;
  const GoalTime now = goal_time(newest());
  trajectory::State state = path_.sample(now);
  if (rests_at(now)) state.velocity = state.acceleration = 0.0;
  braking_ = true;
  lay(StopSearch(encoding_, limits_, path_, now).stop(state), newest());
}

void SetpointStream::come_back(HostTime stamp) {
  const GoalTime now = goal_time(stamp);
  trajectory::State there = history_.at(stamp, encoding_.transmission);
  // A polynomial through whole counts bends by their rounding, the more so the farther it is continued.
  there.acceleration = std::clamp(there.acceleration, -limits_.max_acceleration, limits_.max_acceleration);
  if (braking_) {
    const trajectory::Path before = even(there, now, encoding_.period);
    return lay(StopSearch(encoding_, limits_, before, now).stop(there), stamp);
  }
  bridge(there, stamp);
}

void SetpointStream::bridge(const trajectory::State& there, HostTime stamp) {
  const auto back =
      trajectory::rejoin(path_, there, goal_time(stamp), limits_, kComeBackMargin,
                         kShortestComeBack * encoding_.period, kLongestComeBack * encoding_.period);
  astray_ = !back;
  if (!back) return;
  lay(*back, stamp);
  back_at_ = stamp + host_duration(back->pieces().front().duration().count());
}

std::int32_t SetpointStream::target_at(HostTime stamp) const {
  if (rest_) return *rest_;
  if (!astray_) return encoding::setpoint_at(path_, encoding_.transmission, goal_time(stamp));
  const trajectory::Path further(history_.at(stamp, encoding_.transmission).position);
  return encoding::setpoint_at(further, encoding_.transmission, GoalTime{0.0});
}

std::optional<std::int32_t> SetpointStream::next(HostTime sync) {
  if (sync == kNever) return std::nullopt;
  const HostTime stamp = sync + period_;
  if (stamp <= newest()) return std::nullopt;
  const bool continues = newest() != HostTime{};
  const auto gap = continues ? (stamp - newest() - period_ / 2) / period_ : 0;
  missed_ += static_cast<std::uint64_t>(gap);
  if (gap > 0 && !rest_ && !(rests_at(goal_time(newest())) && rests_at(goal_time(stamp)))) come_back(stamp);
  counts_ = target_at(stamp);
  history_.add(stamp, counts_);
  return counts_;
}

trajectory::State SetpointStream::newest_motion() const {
  if (astray_) return history_.at(newest(), encoding_.transmission);
  const GoalTime time = goal_time(newest());
  return rest_ || rests_at(time) ? trajectory::State{} : path_.sample(time);
}

bool SetpointStream::played(HostTime now) const {
  const GoalTime duration = path_.end_time() - path_.start_time();
  const HostTime end = begin_ + host_duration(duration.count()) + encoding_.order * period_;
  return rest_ || (newest() >= end && now >= end);
}

}  // namespace interpolated_motion::axis
