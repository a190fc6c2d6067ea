#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"

namespace interpolated_motion::axis {

// A drive in motion: feeding, what it executes and reports, its clock, and the end.

using namespace std::chrono_literals;

namespace {

/// Longest the drive may take beyond the duration of its segments, for the error of its clock and the report.
constexpr HostDuration kOvertime = 500ms;
/// A look at the drive's clock that differs more than this (s) from what is expected is none.
constexpr double kPlausible = 0.02;
/// Looks in a row that must contradict what was sent: one may fall between two segments.
constexpr int kMisfits = 2;

}  // namespace

void SilverlodeAxis::feed(HostTime now) {
  if (!second_wait_made_) return;
  const bool few = feed_.waiting(clock_.elapsed(now), true) < kLeastAhead;
  const bool within_horizon = feed_.queue_end() - clock_.elapsed(now) < horizon();
  offer(!feed_.all_sent() && (few || within_horizon), now);
}

void SilverlodeAxis::offer(bool more, HostTime now) {
  if (const auto failure = delivery_->offer(more, rate_for_next(), now)) fail(*failure, now);
}

/// Goal seconds per drive second for the next segment.
double SilverlodeAxis::rate_for_next() const {
  if (!clock_.running()) return 1.0;
  const HostTime knot = clock_.host_time(feed_.queue_end());
  const double due = (feed_.start_goal_time() + GoalTime{seconds(knot - begin_)}).count();
  return clock_.goal_rate(due - feed_.knot_goal_time().count());
}

void SilverlodeAxis::poll_moving(HostTime now) {
  if (auto look = std::exchange(status_.execution, std::nullopt)) take_execution(*look, now);
  if (phase() != Phase::Moving) return;
  feed(now);
  if (phase() != Phase::Moving) return;
  if (!feed_.all_sent() && now >= begin_) {
    const auto fill = feed_.waiting(clock_.elapsed(now), true);
    minimum_fill_ = std::min(minimum_fill_, static_cast<std::uint32_t>(fill));
  }
  watch_motion(now);
}

// The protocol has no checksum: a digit changed on the line makes another segment, and the drive acknowledges
// it. What the drive executes is held against what was sent, so that it goes unnoticed for a moment only.
void SilverlodeAxis::take_execution(const SilverlodeStatus::Execution& look, HostTime now) {
  if (look.outcome.attempts != 1 || look.ticks_left < 1) return;
  const HostTime asked = look.outcome.request_end;
  const double expected = clock_.elapsed(asked);
  const auto instant = feed_.instant_of(look.ticks_left, expected);
  const bool fits =
      instant && std::abs(instant->elapsed - expected) <= kPlausible &&
      look.acceleration.value_or(instant->segment.acceleration) == instant->segment.acceleration &&
      look.velocity.value_or(instant->segment.velocity) == instant->segment.velocity;
  if (fits) {
    misfits_ = 0;
    return learn_clock(asked, instant->elapsed);
  }
  if (++misfits_ < kMisfits) return;
  fail(
      fmt::format("the drive executes a segment that was not sent for {:.3f} s of its motion ({} ticks left, "
                  "acceleration {}, velocity {}): a segment was changed or lost on the line",
                  expected, look.ticks_left, look.acceleration.value_or(0), look.velocity.value_or(0)),
      now);
}

/// Register 18 tells how far the drive has played, at some instant between the end of the command and its
/// execution.
void SilverlodeAxis::learn_clock(HostTime asked, double elapsed) {
  clock_.observe_less_than(asked, elapsed + tick());
  clock_.observe_at_least(asked + parameters_.execution_time, elapsed);
  clock_error_ppm_ = clock_.error_ppm();
}

void SilverlodeAxis::watch_motion(HostTime now) {
  if (!status_.silence.empty())
    return fail(fmt::format("the drive does not answer ({})", std::exchange(status_.silence, {})), now);
  if (status_.io.fault() && status_.io_time > clock_.start_time())
    return fail("the drive reports: " + status_.io.text(), now);
  const bool looked = status_.io_time > clock_.start_time();
  if (looked && !status_.io.trajectory_active()) return end_of_motion(now);
  if (silence(now, std::max(feedback().time, clock_.start_time())) > parameters_.feedback_timeout) {
    return fail(
        fmt::format("no position has come from the drive for {:.2f} s", seconds(now - feedback().time)), now);
  }
  if (clock_.least_elapsed(status_.io_time) > feed_.duration() + seconds(kOvertime)) {
    fail(fmt::format("the drive still moves {:.1f} s after the end of its segments", seconds(kOvertime)),
         now);
  }
}

void SilverlodeAxis::end_of_motion(HostTime now) {
  if (!feed_.all_sent() ||
      clock_.most_elapsed(status_.io_time) + seconds(parameters_.execution_time) < feed_.duration()) {
    ++underruns_;
    return fail(fmt::format("the drive left the interpolated motion {:.3f} s after the start "
                            "instead of {:.3f} s: its queue ran "
                            "dry, or something has stopped it",
                            clock_.elapsed(status_.io_time), feed_.duration()),
                now);
  }
  enter_phase(Phase::Ending, now);
  sequence_.start({read_rest(), read_position()}, now);
}

// The drive's own target tells whether it has gone all of the way.
void SilverlodeAxis::poll_ending(HostTime now) {
  if (!sequence_done(now)) return;
  if (rest_counts_ != feed_.final_counts()) {
    return fail(
        fmt::format(
            "its target is {} counts after the motion instead of {}: a segment was lost or changed on "
            "the line",
            rest_counts_, feed_.final_counts()),
        now);
  }
  clock_.stop();
  finished_ = true;
  enter_phase(Phase::Ready, now);
}

GoalTime SilverlodeAxis::playback(HostTime when) const { return stream_begin_ + playback_of_feed(when); }

GoalTime SilverlodeAxis::playback_of_feed(HostTime when) const {
  if (!feed_.loaded()) return GoalTime{0.0};
  if (clock_.running() && second_wait_made_) return feed_.goal_time_at(clock_.elapsed(when));
  if (finished_) return feed_.path().end_time() + GoalTime{seconds(when - since())};
  return feed_.start_goal_time() - GoalTime{parameters_.start_lead};
}

}  // namespace interpolated_motion::axis
