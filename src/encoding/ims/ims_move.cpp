#include "interpolated_motion_driver/encoding/ims/ims_move.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace interpolated_motion::encoding {

namespace {

using interpolation::ImsProfile;
using interpolation::ImsState;

/// Ticks given to a landing beyond the braking itself: it begins a tick or two late, as its acceleration is
/// rounded up, and a drive may take its last step otherwise than the law here.
constexpr std::int64_t kLandingMargin = 10;

/// Ticks a settling over a few counts takes at least: 8 ms, gently.
constexpr std::int64_t kSettlingTicks = 64;

std::int64_t whole_units(double units, std::int64_t most) {
  return units < static_cast<double>(most) ? static_cast<std::int64_t>(units) : most;
}

std::int64_t with_sign_of(std::int64_t magnitude, std::int64_t sign) {
  return sign < 0 ? -magnitude : magnitude;
}

std::int64_t landing_ticks(const ImsRules& rules, std::int64_t needed, std::int64_t ticks_to_end) {
  return std::min(rules.max_ticks, std::max({needed + kLandingMargin, ticks_to_end, rules.min_ticks}));
}

std::int64_t distance_to(const ImsRules& rules, const ImsState& from, std::int64_t target) {
  return interpolation::ims_at_rest(rules.scale, target).sum - from.sum;
}

double counts(const ImsRules& rules, const ImsState& state) {
  return (static_cast<double>(state.sum) - rules.lag * static_cast<double>(state.velocity)) *
         rules.counts_per_unit;
}

void execute_ramp(const ImsRules& rules, const double* path, const ImsState& from, const ImsMove& move,
                  ImsState& end, ImsFigures& figures) {
  ImsState state = from;
  const std::int64_t low = std::min(from.velocity, move.velocity);
  const std::int64_t high = std::max(from.velocity, move.velocity);
  const std::int64_t step = move.velocity < from.velocity ? -move.step : move.step;
  for (std::int64_t i = 1; i <= move.ticks; ++i) {
    state.velocity = std::min(high, std::max(low, state.velocity + step));
    state.sum += state.velocity;
    figures.deviation = std::max(figures.deviation, std::abs(counts(rules, state) - path[i]));
  }
  figures.peak_velocity = std::max(std::abs(from.velocity), std::abs(state.velocity));
  figures.peak_step = std::min(move.step, high - low);
  end = state;
}

void execute_landing(const ImsRules& rules, const double* path, ImsProfile& profile, std::int64_t ticks,
                     ImsFigures& figures) {
  figures.peak_velocity = std::abs(profile.state().velocity);
  for (std::int64_t i = 1; i <= ticks; ++i) {
    const std::int64_t before = profile.state().velocity;
    profile.tick();
    const ImsState& state = profile.state();
    figures.deviation = std::max(figures.deviation, std::abs(counts(rules, state) - path[i]));
    figures.peak_velocity = std::max(figures.peak_velocity, std::abs(state.velocity));
    figures.peak_step = std::max(figures.peak_step, std::abs(state.velocity - before));
  }
}

}  // namespace

ImsRules::ImsRules(const ImsEncoding& encoding)
    : scale(encoding.law()),
      counts_per_unit(scale.counts_per_unit()),
      lag(scale.position_lag),
      bound(encoding.bound_counts),
      max_velocity(whole_units(encoding.max_motor_rpm * scale.units_per_rpm(), kMaxImsVelocity)),
      max_step(whole_units(encoding.max_motor_acceleration * scale.tick * scale.units_per_rpm(),
                           kMaxImsAcceleration / scale.acceleration_per_step())),
      min_ticks(encoding.min_segment_ticks),
      max_ticks(encoding.max_segment_ticks) {}

ImsMove plan_ramp(const ImsRules& rules, const ImsState& from, std::int64_t ticks, double acceleration) {
  ImsMove move;
  move.ticks = ticks;
  move.step = std::llround(std::abs(acceleration) / rules.counts_per_unit);
  move.velocity = from.velocity + with_sign_of(move.step * ticks, acceleration < 0 ? -1 : 1);
  const bool passes_zero =
      (from.velocity > 0 && move.velocity < 0) || (from.velocity < 0 && move.velocity > 0);
  const std::int64_t speed = std::abs(from.velocity);
  // The rest of a division by the ticks is less than one step a tick: such a ramp is meant to end at rest.
  if (passes_zero || (speed > 0 && std::abs(move.velocity) < ticks && move.step > 1)) {
    move.step = (speed + ticks - 1) / ticks;
    move.velocity = 0;
  }
  return move;
}

bool plan_landing(const ImsRules& rules, std::int64_t ticks_to_end, const ImsState& from, std::int64_t target,
                  ImsMove& move) {
  const std::int64_t speed = std::abs(from.velocity);
  const std::int64_t left = with_sign_of(1, from.velocity) * distance_to(rules, from, target);
  if (speed == 0 || left <= 0) return false;
  // Braking at once covers v^2 / (2 s) - v / 2.
  const double needed = static_cast<double>(speed) * static_cast<double>(speed) /
                        (2.0 * static_cast<double>(left) + static_cast<double>(speed));
  if (!(needed < static_cast<double>(rules.max_step))) return false;
  std::int64_t step = std::max<std::int64_t>(1, static_cast<std::int64_t>(needed));
  while (interpolation::stopping_sum(speed, step) - speed > left) ++step;
  // Where a unit a tick is more than it takes, the drive holds its velocity first.
  const std::int64_t held = (left - (interpolation::stopping_sum(speed, step) - speed)) / speed;
  const std::int64_t needed_ticks = held + (speed + step - 1) / step;
  if (needed_ticks + kLandingMargin > rules.max_ticks) return false;
  move = {landing_ticks(rules, needed_ticks, ticks_to_end), from.velocity, step, true, target};
  return true;
}

ImsMove plan_settling(const ImsRules& rules, std::int64_t ticks_to_end, const ImsState& from,
                      std::int64_t target) {
  const std::int64_t distance = distance_to(rules, from, target);
  const std::int64_t way = std::abs(distance);
  // A triangle of n ticks covers step n^2 / 4 and peaks at step n / 2.
  const double slowest = 2.0 * std::sqrt(static_cast<double>(way) / static_cast<double>(rules.max_step));
  const auto ticks = std::max(kSettlingTicks, static_cast<std::int64_t>(std::min(slowest, 1e6)) + 2);
  const std::int64_t step = std::max<std::int64_t>(1, std::min(rules.max_step, 4 * way / (ticks * ticks)));
  const std::int64_t velocity = std::max<std::int64_t>(1, step * (ticks / 2));
  return {landing_ticks(rules, ticks, ticks_to_end), with_sign_of(velocity, distance), step, true, target};
}

ImsSegment segment_of(const ImsRules& rules, const ImsState& from, const ImsMove& move) {
  const std::int64_t present = interpolation::ims_nearest_count(rules.scale, from);
  const std::int64_t heading = from.velocity != 0 ? from.velocity : move.velocity;
  std::int64_t position = present;
  if (move.lands) {
    position = move.target;
  } else if (heading != 0) {
    position += with_sign_of(kImsProjection, heading);
  }
  return {static_cast<std::int32_t>(move.ticks), interpolation::ims_register(position),
          static_cast<std::int32_t>(move.step * rules.scale.acceleration_per_step()),
          static_cast<std::int32_t>(std::abs(move.velocity))};
}

bool execute(const ImsRules& rules, const TickSamples& samples, std::int64_t tick, const ImsState& from,
             const ImsMove& move, ImsState& end, ImsFigures& figures) {
  figures = ImsFigures();
  ImsProfile profile(rules.scale, from);
  profile.load(segment_of(rules, from, move));
  const double* path = samples.counts_from(tick);
  if (move.lands) {
    execute_landing(rules, path, profile, move.ticks, figures);
    end = profile.state();
    return end == interpolation::ims_at_rest(rules.scale, move.target);
  }
  if (!profile.runs_free(move.ticks)) return false;
  execute_ramp(rules, path, from, move, end, figures);
  return true;
}

}  // namespace interpolated_motion::encoding
