#include "interpolated_motion_driver/interpolation/ims_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace interpolated_motion::interpolation {

namespace {

constexpr double kFullScale = 2147483648.0;  // 2^31, of velocity and acceleration alike
constexpr double kSecondsPerMinute = 60.0;

/// A count of 2^20 to 2^40 units keeps both the sum over any motion and the resolution far from their ends.
constexpr double kMinUnitsPerCount = 1048576.0;
constexpr double kMaxUnitsPerCount = 1099511627776.0;

void require(bool allowed, const char* parameter, double value, const char* range) {
  if (allowed) return;
  throw std::invalid_argument(fmt::format("IMS scale: {} is {}, allowed is {}.", parameter, value, range));
}

bool finite_positive(double value) { return value > 0 && std::isfinite(value); }

std::int64_t sum_of(const ImsScale& scale, std::int64_t counts) {
  return std::llround(static_cast<double>(counts) * scale.units_per_count());
}

}  // namespace

double ImsScale::counts_per_unit() const {
  return counts_per_revolution * velocity_full_scale_rpm / kSecondsPerMinute * tick / kFullScale;
}

double ImsScale::units_per_rpm() const { return kFullScale / velocity_full_scale_rpm; }

std::int64_t ImsScale::acceleration_per_step() const {
  return std::llround(velocity_full_scale_rpm / acceleration_full_scale_rpm_per_tick);
}

void ImsScale::validate() const {
  require(finite_positive(counts_per_revolution), "counts_per_revolution", counts_per_revolution,
          "greater than 0");
  require(finite_positive(velocity_full_scale_rpm), "velocity_full_scale_rpm", velocity_full_scale_rpm,
          "greater than 0");
  require(finite_positive(acceleration_full_scale_rpm_per_tick), "acceleration_full_scale_rpm_per_tick",
          acceleration_full_scale_rpm_per_tick, "greater than 0");
  require(finite_positive(tick), "tick", tick, "greater than 0 s");
  require(position_lag >= 0 && position_lag <= 1, "position_lag", position_lag, "0 to 1 tick");
  const double ratio = velocity_full_scale_rpm / acceleration_full_scale_rpm_per_tick;
  require(ratio >= 0.5 && ratio < 1e6 && std::abs(ratio - std::round(ratio)) <= 1e-9 * ratio,
          "acceleration_full_scale_rpm_per_tick", acceleration_full_scale_rpm_per_tick,
          "velocity_full_scale_rpm divided by a whole number");
  require(units_per_count() >= kMinUnitsPerCount && units_per_count() <= kMaxUnitsPerCount,
          "units per count (2^31 * 60 s / (counts_per_revolution * velocity_full_scale_rpm * tick))",
          units_per_count(), "2^20 to 2^40");
}

ImsState ims_at_rest(const ImsScale& scale, std::int64_t counts) { return {sum_of(scale, counts), 0}; }

double ims_counts(const ImsScale& scale, const ImsState& state) {
  const double lag = scale.position_lag * static_cast<double>(state.velocity);
  return (static_cast<double>(state.sum) - lag) * scale.counts_per_unit();
}

std::int64_t ims_nearest_count(const ImsScale& scale, const ImsState& state) {
  return std::llround(ims_counts(scale, state));
}

std::int32_t ims_register(std::int64_t counts) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(counts)));
}

ImsState ramp_and_hold(const ImsState& from, std::int64_t velocity, std::int64_t step, std::int64_t ticks) {
  if (step == 0) return {from.sum + from.velocity * ticks, from.velocity};
  const std::int64_t change = velocity - from.velocity;
  const std::int64_t signed_step = change < 0 ? -step : step;
  const std::int64_t ramp = std::min(ticks, std::abs(change) / step);
  const std::int64_t end = ramp < ticks ? velocity : from.velocity + signed_step * ramp;
  const std::int64_t ramp_sum = from.velocity * ramp + signed_step * (ramp * (ramp + 1) / 2);
  return {from.sum + ramp_sum + end * (ticks - ramp), end};
}

std::int64_t stopping_sum(std::int64_t velocity, std::int64_t step) {
  if (velocity <= 0) return 0;
  const std::int64_t last = (velocity - 1) / step;  // velocity - last * step is the last positive one
  return (last + 1) * velocity - step * (last * (last + 1) / 2);
}

std::int64_t greatest_landing_velocity(std::int64_t distance, std::int64_t step) {
  if (distance <= 0) return 0;
  // Braking from n steps covers step n (n + 1) / 2: the greatest n below `distance`, then linear in the rest.
  const auto below = [&](std::int64_t n) { return n == 0 || step * (n * (n + 1) / 2) < distance; };
  const double ratio = 2.0 * static_cast<double>(distance) / static_cast<double>(step);
  auto n = static_cast<std::int64_t>((std::sqrt(4.0 * ratio + 1.0) - 1.0) / 2.0);
  while (!below(n)) --n;
  while (below(n + 1)) ++n;
  return (distance + step * (n * (n + 1) / 2)) / (n + 1);
}

ImsProfile::ImsProfile(const ImsScale& scale, const ImsState& state) : scale_(scale), state_(state) {}

void ImsProfile::load(const ImsSegment& segment) {
  const std::int64_t present = ims_nearest_count(scale_, state_);
  // Subtracted modulo 2^32, as the drive does.
  const std::int64_t difference = ims_register(segment.position - present);
  target_ = sum_of(scale_, present + difference);
  const std::int64_t towards = target_ != state_.sum ? target_ - state_.sum : state_.velocity;
  direction_ = towards < 0 ? -1 : 1;
  velocity_ = segment.velocity;
  step_ = segment.acceleration / scale_.acceleration_per_step();
}

void ImsProfile::tick() {
  if (step_ > 0) {
    const std::int64_t now = direction_ * state_.velocity;
    const std::int64_t left = direction_ * (target_ - state_.sum);
    std::int64_t next = now < velocity_ ? std::min(velocity_, now + step_) : std::max(velocity_, now - step_);
    if (next > 0 && stopping_sum(next, step_) > left) {
      const std::int64_t slowest = std::max<std::int64_t>(0, now - step_);
      next = std::min(left, std::max(slowest, std::min(next, greatest_landing_velocity(left, step_))));
    }
    state_.velocity = direction_ * next;
  }
  state_.sum += state_.velocity;
}

bool ImsProfile::runs_free(std::int64_t ticks) const {
  if (step_ == 0) return true;
  const ImsState end = ramp_and_hold(state_, direction_ * velocity_, step_, ticks);
  const std::int64_t fastest = std::max(direction_ * state_.velocity, direction_ * end.velocity);
  const bool forwards = direction_ * state_.velocity >= 0;
  return forwards && stopping_sum(fastest, step_) <= direction_ * (target_ - end.sum);
}

}  // namespace interpolated_motion::interpolation
