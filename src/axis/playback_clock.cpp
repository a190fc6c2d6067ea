#include "interpolated_motion_driver/axis/playback_clock.h"

#include <algorithm>
#include <limits>

namespace interpolated_motion::axis {

namespace {

/// What a drive is ahead or behind is made good in this time, s.
constexpr double kCatchUpTime = 2.0;

}  // namespace

PlaybackClock::PlaybackClock(double max_error, double sample, Estimate estimate)
    : max_error_(max_error),
      sample_(sample),
      estimate_(estimate),
      lowest_rate_(1.0 - max_error),
      highest_rate_(1.0 + max_error) {}

void PlaybackClock::start(HostTime start, bool follows_host) {
  running_ = true;
  follows_host_ = follows_host;
  start_ = start;
  lowest_rate_ = 1.0 - max_error_;
  highest_rate_ = 1.0 + max_error_;
}

double PlaybackClock::rate() const {
  if (follows_host_) return 1.0;
  if (estimate_ == Estimate::Middle) return 0.5 * (lowest_rate_ + highest_rate_);
  return std::clamp(1.0, lowest_rate_, highest_rate_);
}

double PlaybackClock::elapsed(HostTime when) const {
  if (!running_ || when <= start_) return 0.0;
  return seconds(when - start_) * rate();
}

double PlaybackClock::least_elapsed(HostTime when) const {
  if (!running_ || when <= start_) return 0.0;
  const double host = seconds(when - start_);
  return std::max(0.0, follows_host_ ? host - kFollowing : host * lowest_rate_ - sample_);
}

double PlaybackClock::most_elapsed(HostTime when) const {
  if (!running_ || when <= start_) return 0.0;
  const double host = seconds(when - start_);
  return follows_host_ ? host + kFollowing : host * highest_rate_ + sample_;
}

HostTime PlaybackClock::host_time(double drive_seconds) const {
  return start_ + host_duration(drive_seconds / rate());
}

// The newest observation wins over a bound it contradicts: a crystal that changes with temperature shifts the
// estimate. A wrong report cannot throw it further than `max_error_`.
void PlaybackClock::observe_at_least(HostTime when, double drive_seconds) {
  const double host = seconds(when - start_);
  if (!running_ || host <= sample_) return;
  lowest_rate_ = std::max(lowest_rate_, std::min((drive_seconds - sample_) / host, 1.0 + max_error_));
  highest_rate_ = std::max(highest_rate_, lowest_rate_);
}

void PlaybackClock::observe_less_than(HostTime when, double drive_seconds) {
  const double host = seconds(when - start_);
  if (!running_ || host <= sample_) return;
  highest_rate_ = std::min(highest_rate_, std::max((drive_seconds + sample_) / host, 1.0 - max_error_));
  lowest_rate_ = std::min(lowest_rate_, highest_rate_);
}

double PlaybackClock::goal_rate(double behind) const {
  if (!running_ || follows_host_) return 1.0;
  const double most = 2.0 * max_error_;
  return std::clamp(1.0 / rate() + behind / kCatchUpTime, 1.0 - most, 1.0 + most);
}

double PlaybackClock::error_ppm() const {
  if (follows_host_) return 0.0;
  const bool known = lowest_rate_ > 1.0 - max_error_ || highest_rate_ < 1.0 + max_error_;
  return known ? (rate() - 1.0) * 1e6 : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace interpolated_motion::axis
