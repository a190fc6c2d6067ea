#include "interpolated_motion_driver/axis/silverlode/execution_watch.h"

#include <cmath>

#include <fmt/format.h>

namespace interpolated_motion::axis {

namespace {

/// A look at the drive's clock that differs more than this (s) from what is expected is none.
constexpr double kPlausible = 0.02;
/// Looks in a row that must contradict what was sent: one may fall between two segments, and a drive that
/// has stopped by itself is to say why first.
constexpr int kMisfits = 2;

/// What register 0 may be beside the demand as it was planned: rounding, and what may pass between the
/// readings of two registers for one reply.
constexpr double kTargetCounts = 20.0;
constexpr double kTargetTicks = 4.0;

/// As registers differ, which wrap around.
double difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

std::string segment_text(const SilverlodeStatus::Execution& look, double elapsed) {
  return fmt::format(
      "the drive executes a segment that was not sent for {:.3f} s of its motion ({} ticks left, "
      "acceleration {}, velocity {}): a segment was changed or lost on the line",
      elapsed, look.ticks_left, look.acceleration.value_or(0), look.velocity.value_or(0));
}

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
  if (!fits) return misfit(misfits_, segment_text(look, expected));
  misfits_ = 0;
  learn_clock(asked, instant->elapsed);
  return watch_position(look, *instant);
}

/// Of what a drive is sent it may be its following error away, and its demand nothing but the ticks between
/// two registers that are read one after the other.
std::optional<std::string> ExecutionWatch::watch_position(const SilverlodeStatus::Execution& look,
                                                          const SegmentFeed::Instant& instant) {
  const double scale = std::abs(parameters_.transmission.counts_per_radian());
  const double following = scale * parameters_.max_following_error;
  const double demand = kTargetCounts + kTargetTicks * instant.speed;
  const double allowed = look.target ? demand : following;
  const std::int32_t seen = look.target ? *look.target : look.position.value_or(instant.counts);
  const double off = std::abs(difference(seen, instant.counts));
  if (off > allowed) return misfit(strays_, stray_text(off / scale, look.target.has_value()));
  strays_ = 0;
  return std::nullopt;
}

std::optional<std::string> ExecutionWatch::misfit(int& in_a_row, std::string text) {
  if (++in_a_row < kMisfits) return std::nullopt;
  return text;
}

std::string ExecutionWatch::stray_text(double off, bool demand) const {
  const std::string unit = trajectory::symbol(parameters_.limits.unit);
  const std::string much = fmt::format("{:.4f} {} beside what it was sent", off, unit);
  const std::string changed = "a segment was changed or lost on the line";
  if (demand) {
    return fmt::format(
        "the drive's demand (register 0) is {}: {}, or register 0 does not tell the demand "
        "in motion (target_in_motion: false)",
        much, changed);
  }
  return fmt::format("the drive is {}, more than max_following_error ({} {}): {}", much,
                     parameters_.max_following_error, unit, changed);
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
