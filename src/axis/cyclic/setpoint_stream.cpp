#include "interpolated_motion_driver/axis/cyclic/setpoint_stream.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "interpolated_motion_driver/trajectory/jerk_limited_stop.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
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

constexpr double kHistory = interpolation::kCipHistory;
/// Target positions that a drive which is not heard of is sent where it goes by itself. By then one that has
/// received none has braked; one that does receive them must not be led farther astray.
constexpr int kMostUnheard = 5;

/// Largest acceleration of what a drive makes of a stop, per s^2.
using StopDemand = std::function<double(const trajectory::Path&)>;

/// How a stop that begins at `start` is made for a drive.
class StopSearch {
 public:
  StopSearch(const encoding::SetpointEncoding& encoding, const trajectory::JointLimits& limits,
             GoalTime start, StopDemand demand)
      : encoding_(encoding), limits_(limits), start_(start), demand_(std::move(demand)) {}

  /// The shortest of which the drive's demand keeps the limit of acceleration; else the smoothest for which
  /// there is room; else the shortest of all.
  trajectory::Path stop(const trajectory::State& from) const {
    std::optional<trajectory::Path> best;
    double least = std::numeric_limits<double>::infinity();
    for (const int periods : kRamps) {
      const trajectory::Path candidate = trajectory::jerk_limited_stop(
          from, start_, {kBrakingShare * limits_.max_acceleration, periods * encoding_.period});
      if (trajectory::find_position_violation(candidate, limits_)) break;
      const double acceleration = demand_(candidate);
      if (acceleration >= least) continue;
      best = candidate;
      least = acceleration;
      if (acceleration <= limits_.max_acceleration) break;
    }
    return best ? *best : trajectory::shortest_stop_path(from, start_, limits_);
  }

 private:
  const encoding::SetpointEncoding& encoding_;
  const trajectory::JointLimits& limits_;
  GoalTime start_;
  StopDemand demand_;
};

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

/// Whether all that the drive has been told to interpolate through is one position, and so until `stamp`.
bool SetpointStream::rests_until(HostTime stamp) const {
  return rest_ || goal_time(stamp) <= path_.start_time() ||
         goal_time(history_.oldest_in_use()) >= path_.end_time();
}

void SetpointStream::brake() {
  if (rest_) return;
  const GoalTime now = goal_time(newest());
  trajectory::State state = path_.sample(now);
  if (rests_at(now)) state.velocity = state.acceleration = 0.0;
  if (is_unheard()) state = newest_motion();
  braking_ = true;
  if (is_unheard() || newest() < back_at_) return lay(stop_off_the_path(state, newest()), newest());
  const auto demand = [this, now](const trajectory::Path& stop) {
    const GoalTime first = now - kHistory * encoding_.period;
    return encoding::demand_acceleration(trajectory::splice(path_, first, now, stop), first, encoding_);
  };
  lay(StopSearch(encoding_, limits_, now, demand).stop(state), newest());
}

Departure SetpointStream::departure(const trajectory::State& there, HostTime stamp) const {
  const HostTime origin = begin_ - host_duration(path_.start_time().count());
  const HostTime next = std::max(stamp, newest() + period_);
  return {there, goal_time(stamp), goal_time(next), history_.knots(origin, encoding_.transmission)};
}

void SetpointStream::come_back(HostTime stamp) {
  trajectory::State there = history_.at(stamp, encoding_.transmission);
  // A polynomial through whole counts bends by their rounding, the more so the farther it is continued.
  there.acceleration = std::clamp(there.acceleration, -limits_.max_acceleration, limits_.max_acceleration);
  if (!braking_) return bridge(there, stamp);
  lay(stop_off_the_path(there, stamp), stamp);
}

/// There is no path behind a drive that went astray, only what it has been told.
trajectory::Path SetpointStream::stop_off_the_path(const trajectory::State& there, HostTime stamp) const {
  const Departure from = departure(there, stamp);
  const auto demand = [this, &from](const trajectory::Path& stop) {
    return demand_acceleration(from, stop, stop.end_time() + kHistory * encoding_.period, encoding_);
  };
  return StopSearch(encoding_, limits_, from.start, demand).stop(there);
}

void SetpointStream::bridge(const trajectory::State& there, HostTime stamp) {
  const Departure from = departure(there, stamp);
  const auto back = way_back(path_, from, limits_, encoding_);
  astray_ = !back;
  if (!back) return;
  const GoalTime end = back->pieces().front().end;
  const double off = encoding::demand_departure(from.known, from.next, end + kHistory * encoding_.period,
                                                *back, path_, encoding_);
  detour_ = Detour{off, host_duration((end - from.start).count())};
  lay(*back, stamp);
  back_at_ = stamp + detour_->duration;
}

std::int32_t SetpointStream::target_at(HostTime stamp) const {
  if (rest_) return *rest_;
  if (astray_) return further(stamp);
  return encoding::setpoint_at(path_, encoding_.transmission, goal_time(stamp));
}

/// Where the drive goes by itself.
std::int32_t SetpointStream::further(HostTime stamp) const {
  const trajectory::Path there(history_.at(stamp, encoding_.transmission).position);
  return encoding::setpoint_at(there, encoding_.transmission, GoalTime{0.0});
}

std::optional<std::int32_t> SetpointStream::next(HostTime sync, bool heard) {
  if (sync == kNever) return std::nullopt;
  const HostTime stamp = sync + period_;
  if (stamp <= newest()) return std::nullopt;
  if (goes_unheard(sync, heard)) {
    counts_ = further(stamp);
  } else {
    const bool continues = newest() != HostTime{};
    const auto gap = continues ? (stamp - newest() - period_ / 2) / period_ : 0;
    missed_ += static_cast<std::uint64_t>(gap);
    if (gap > 0 && !rests_until(stamp)) come_back(stamp);
    counts_ = target_at(stamp);
  }
  history_.add(stamp, counts_);
  return counts_;
}

/// Takes back, of the target positions so far, those of which it is not known that they have arrived. Of the
/// SYNC before the last the drive has told nothing: those of that one and of the last are the first.
bool SetpointStream::goes_unheard(HostTime sync, bool heard) {
  const bool goes = !heard && unheard_ < kMostUnheard && !rests_until(sync + period_);
  if (goes && !is_unheard()) unheard_from_ = sync - 2 * period_;
  if (is_unheard()) history_.drop(unheard_from_, sync);
  unheard_ = goes ? unheard_ + 1 : heard ? 0 : unheard_;
  if (!goes) unheard_from_ = kNever;
  return goes;
}

// Of those before the newest no later look at the newest will tell.
void SetpointStream::leave_out(HostTime first, HostTime last) {
  const HostTime before = newest();
  const std::size_t dropped = history_.drop(first, last);
  if (newest() == before) missed_ += dropped;
}

trajectory::State SetpointStream::newest_motion() const {
  if (astray_ || is_unheard()) return history_.at(newest(), encoding_.transmission);
  const GoalTime time = goal_time(newest());
  return rest_ || rests_at(time) ? trajectory::State{} : path_.sample(time);
}

bool SetpointStream::played(HostTime now) const {
  const GoalTime duration = path_.end_time() - path_.start_time();
  const HostTime end = begin_ + host_duration(duration.count());
  return rest_ || (history_.oldest_in_use() >= end && now >= end + encoding_.order * period_);
}

}  // namespace interpolated_motion::axis
