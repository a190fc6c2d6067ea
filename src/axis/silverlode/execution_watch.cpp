#include "interpolated_motion_driver/axis/silverlode/execution_watch.h"

#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::axis {

namespace {

/// A look at the drive's clock that differs more than this (s) from what is expected is none.
constexpr double kPlausible = 0.02;
/// Looks in a row that must contradict what was sent: one may fall between two segments.
constexpr int kMisfits = 2;

}  // namespace

std::optional<std::string> ExecutionWatch::take(const SilverlodeStatus::Execution& look) {
  if (look.outcome.attempts != 1 || look.ticks_left < 1) return std::nullopt;
  const HostTime asked = look.outcome.request_end;
  const double expected = clock_.elapsed(asked);
  const auto instant = feed_.instant_of(look.ticks_left, expected);
  const bool fits =
      instant && std::abs(instant->elapsed - expected) <= kPlausible &&
      look.acceleration.value_or(instant->segment.acceleration) == instant->segment.acceleration &&
      look.velocity.value_or(instant->segment.velocity) == instant->segment.velocity;
  if (fits) {
    misfits_ = 0;
    learn_clock(asked, instant->elapsed);
    return std::nullopt;
  }
  if (++misfits_ < kMisfits) return std::nullopt;
  return fmt::format(
      "the drive executes a segment that was not sent for {:.3f} s of its motion ({} ticks left, "
      "acceleration {}, velocity {}): a segment was changed or lost on the line",
      expected, look.ticks_left, look.acceleration.value_or(0), look.velocity.value_or(0));
}

/// Register 18 tells how far the drive has played, at some instant between the end of the command and its
/// execution.
void ExecutionWatch::learn_clock(HostTime asked, double elapsed) {
  clock_.observe_less_than(asked, elapsed + parameters_.scale.tick);
  clock_.observe_at_least(asked + parameters_.execution_time, elapsed);
  if (const double error = clock_.error_ppm(); !std::isnan(error)) clock_error_ppm_ = error;
}

double ExecutionWatch::clock_rate() const {
  return std::isnan(clock_error_ppm_) ? 1.0 : 1.0 + 1e-6 * clock_error_ppm_;
}

}  // namespace interpolated_motion::axis
