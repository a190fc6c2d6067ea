#include "interpolated_motion_driver/emulation/silverdust/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

namespace interpolated_motion::emulation {
namespace {

constexpr std::int64_t kFullScale = std::int64_t{1} << 31;
constexpr std::int64_t kNanosecondsPerMinute = 60'000'000'000;
constexpr std::int64_t kLargestAdvance = std::int64_t{1} << 28;
constexpr std::int64_t kLargestCount = std::int64_t{1} << 46;
constexpr std::int64_t kFar = std::int64_t{1} << 62;

// More ticks of braking than this lead beyond any 32 bit position, and their sum would not fit into 64 bits.
constexpr std::int64_t kLongestBraking = std::int64_t{1} << 28;

std::int64_t floor_division(std::int64_t dividend, std::int64_t divisor) {
  const std::int64_t quotient = dividend / divisor;
  return dividend % divisor < 0 ? quotient - 1 : quotient;
}

std::int64_t subdivision_of(const SilverDustParameters& p) {
  if (p.acceleration_rounding == AccelerationRounding::Truncated) return 1;
  const std::int64_t velocity = p.velocity_full_scale_rpm;
  const std::int64_t scales =
      std::gcd<std::int64_t, std::int64_t>(p.ims_acceleration_full_scale, p.acceleration_full_scale);
  return velocity / std::gcd(velocity, scales);
}

}  // namespace

ProfileScale::ProfileScale(const SilverDustParameters& p)
    : subdivision(subdivision_of(p)),
      velocity_full_scale_(p.velocity_full_scale_rpm),
      rounding_(p.acceleration_rounding) {
  // Counts per tick of one fraction: rpm * counts per revolution * tick / (1 min * 2^31 * subdivision).
  advance = static_cast<std::int64_t>(p.velocity_full_scale_rpm) * p.counts_per_revolution * p.tick.count();
  bool fits = subdivision <= 4096;
  for (std::int64_t factor : {kNanosecondsPerMinute, kFullScale, subdivision}) {
    const std::int64_t common = std::gcd(advance, factor);
    advance /= common;
    factor /= common;
    fits = fits && factor <= kLargestCount / count;
    count *= fits ? factor : 1;
  }
  if (fits && advance * subdivision <= kLargestAdvance) return;
  throw std::invalid_argument(fmt::format(
      "emulated drive with address {}: velocity_full_scale_rpm {}, counts_per_revolution {} and tick "
      "{} ns have no exact ratio that fits into 64 bits",
      p.address, p.velocity_full_scale_rpm, p.counts_per_revolution, p.tick.count()));
}

std::int64_t ProfileScale::step(std::int64_t acceleration, int full_scale) const {
  if (rounding_ == AccelerationRounding::Truncated) return acceleration * full_scale / velocity_full_scale_;
  return acceleration * (full_scale * subdivision / velocity_full_scale_);
}

ProfileGenerator::ProfileGenerator(const SilverDustParameters& parameters)
    : scale_(parameters), integration_(parameters.integration) {}

void ProfileGenerator::place(std::int64_t counts) {
  counts_ = counts;
  fraction_ = 0;
  velocity_ = 0;
  command_ = Command::Stand;
}

void ProfileGenerator::move_to(std::int32_t position, const Ramps& ramps, std::int64_t velocity) {
  command_ = Command::MoveTo;
  goal_ = position;
  step_ = ramps.up;
  braking_ = ramps.down;
  speed_ = scale_.velocity(velocity);
}

void ProfileGenerator::run_at(std::int64_t velocity, std::int64_t step) {
  command_ = Command::RunAt;
  step_ = step;
  speed_ = scale_.velocity(velocity);
}

void ProfileGenerator::brake(std::int64_t step) {
  run_at(0, step);
  if (step == 0) velocity_ = 0;
}

double ProfileGenerator::position() const {
  return static_cast<double>(counts_) +
         static_cast<double>(fraction_) / static_cast<double>(2 * scale_.count);
}

double ProfileGenerator::counts_per_tick() const {
  return static_cast<double>(velocity_ * scale_.advance) / static_cast<double>(scale_.count);
}

double ProfileGenerator::counts_per_tick_at_full_scale() const {
  return static_cast<double>(scale_.velocity(kFullScale) * scale_.advance) /
         static_cast<double>(scale_.count);
}

bool ProfileGenerator::done() const {
  if (velocity_ != 0 || command_ == Command::Stand) return velocity_ == 0;
  return command_ == Command::RunAt ? speed_ == 0 : remaining() == 0 || step_ == 0 || speed_ == 0;
}

void ProfileGenerator::tick() {
  if (command_ == Command::Stand) return;
  const std::int64_t old = velocity_;
  switch (integration_) {
    case Integration::MeanVelocity:
      // Half of the old velocity is travelled whatever the new one is.
      velocity_ = next_velocity(old * scale_.advance);
      return move_by((old + velocity_) * scale_.advance);
    case Integration::VelocityFirst:
      velocity_ = next_velocity(0);
      return move_by(2 * velocity_ * scale_.advance);
    case Integration::PositionFirst:
      move_by(2 * old * scale_.advance);
      velocity_ = next_velocity(0);
      return;
  }
}

void ProfileGenerator::move_by(std::int64_t distance) {
  const std::int64_t sum = fraction_ + distance;
  const std::int64_t whole = floor_division(sum, 2 * scale_.count);
  counts_ += whole;
  fraction_ = sum - whole * 2 * scale_.count;
}

// Velocity of the next tick, when the target will have moved by `ahead` before it counts.
std::int64_t ProfileGenerator::next_velocity(std::int64_t ahead) {
  if (command_ == Command::RunAt) {
    return velocity_ < speed_ ? std::min(velocity_ + step_, speed_) : std::max(velocity_ - step_, speed_);
  }
  if (step_ == 0) return velocity_;
  const std::int64_t rest = remaining() - ahead;
  if (rest == 0 && velocity_ == 0) return 0;
  if (std::abs(rest) < 2 * scale_.advance && std::abs(velocity_) <= braking_) {
    move_by(rest);
    return 0;
  }
  const bool forward = rest != 0 ? rest > 0 : velocity_ > 0;
  const std::int64_t speed = forward ? velocity_ : -velocity_;
  const std::int64_t next = approach(std::abs(rest), speed);
  return forward ? next : -next;
}

// Distance to the commanded position in the unit of `fraction_`, the nearer way round the 32 bit range.
std::int64_t ProfileGenerator::remaining() const {
  const std::uint32_t difference = static_cast<std::uint32_t>(goal_) - static_cast<std::uint32_t>(counts_);
  const std::int64_t whole = static_cast<std::int32_t>(difference);
  const std::int64_t representable = kFar / (2 * scale_.count);
  return std::clamp(whole, -representable, representable) * 2 * scale_.count - fraction_;
}

std::int64_t ProfileGenerator::ramp(std::int64_t speed) const {
  return speed < speed_ ? std::min(speed + step_, speed_) : std::max(speed - braking_, speed_);
}

// Speed of the next tick, in the direction of the commanded position, which is `distance` away.
std::int64_t ProfileGenerator::approach(std::int64_t distance, std::int64_t speed) const {
  if (speed < 0) return std::min<std::int64_t>(speed + braking_, 0);
  const std::int64_t reach = distance / (2 * scale_.advance);
  std::int64_t high = ramp(speed);
  if (stopping_distance(high) <= reach) return high;
  std::int64_t low = std::max<std::int64_t>(speed - 2 * braking_, 0);
  if (stopping_distance(low) > reach) return std::max<std::int64_t>(speed - braking_, 0);
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (stopping_distance(middle) <= reach ? low : high) = middle;
  }
  return low;
}

// Distance of one tick at `speed` and of all ticks of braking after it, in fractions times ticks:
// speed + (speed - braking) + (speed - 2 braking) + ... while positive.
std::int64_t ProfileGenerator::stopping_distance(std::int64_t speed) const {
  const std::int64_t ticks = speed / braking_;
  if (ticks > kLongestBraking) return kFar;
  return speed * (ticks + 1) - braking_ * (ticks * (ticks + 1) / 2);
}

}  // namespace interpolated_motion::emulation
