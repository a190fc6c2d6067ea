#include <algorithm>
#include <cmath>
#include <limits>

#include "epos_drive_implementation.h"

namespace interpolated_motion::emulation {
namespace {

constexpr std::uint16_t kFollowingError = 0x8611;
constexpr std::uint16_t kInterpolationError = 0xFF0C;
constexpr std::uint16_t kPositionLimitError = 0xFF09;
constexpr std::int64_t kNoLimit = 0xFFFFFFFF;
constexpr double kMillisecondsPerSecond = 1e3;

constexpr ObjectDictionary::Slot kPositionDemand = kObject<0x6062, 0>;
constexpr ObjectDictionary::Slot kPositionActual = kObject<0x6064, 0>;
constexpr ObjectDictionary::Slot kMaximumFollowingError = kObject<0x6065, 0>;
constexpr ObjectDictionary::Slot kPositionWindow = kObject<0x6067, 0>;
constexpr ObjectDictionary::Slot kVelocitySensor = kObject<0x6069, 0>;
constexpr ObjectDictionary::Slot kVelocityDemand = kObject<0x606B, 0>;
constexpr ObjectDictionary::Slot kVelocityActual = kObject<0x606C, 0>;
constexpr ObjectDictionary::Slot kFollowingErrorActual = kObject<0x20F4, 0>;

std::int64_t rounded(double value) { return static_cast<std::int64_t>(std::floor(value + 0.5)); }

std::int64_t to_int16(double value) {
  return rounded(std::clamp<double>(value, std::numeric_limits<std::int16_t>::min(),
                                    std::numeric_limits<std::int16_t>::max()));
}

}  // namespace

void EposDrive::Implementation::sample() {
  move();
  publish_motion();
  if (observer_) observe();
}

void EposDrive::Implementation::move() {
  interpolated_sample_ = false;
  if (!device_.power_stage()) {
    plant_.stand();
    demand_ = {plant_.position(), 0.0, 0.0};
    return;
  }
  if (device_.ramp() != StopRamp::None) {
    slow_down(ramp_deceleration());
    if (demand_.velocity == 0.0) device_.at_rest();
  } else if (halt_) {
    if (parameters_.halt_release == HaltRelease::NeedsNewStart) ip_.stop();
    halted_ = ip_.active();
    slow_down(profile_deceleration_);
  } else if (ip_.active()) {
    interpolate();
  } else {
    slow_down(profile_deceleration_);
    if (start_requested_ && demand_.velocity == 0.0) begin_interpolation();
  }
  plant_.follow(demand_.position);
  check_following_error();
}

void EposDrive::Implementation::begin_interpolation() {
  start_requested_ = false;
  const InterpolationEvent event = ip_.start(demand_.position);
  interpolated_sample_ = ip_.active();
  handle(event);
}

void EposDrive::Implementation::interpolate() {
  if (halted_) ip_.resume(demand_.position);
  halted_ = false;
  interpolated_sample_ = true;
  handle(ip_.sample(demand_));
}

void EposDrive::Implementation::handle(InterpolationEvent event) {
  if (!is_error(event)) return;
  if (event == InterpolationEvent::PositionLimit) {
    fault(kPositionLimitError, parameters_.motion_error_register, now());
  } else {
    fault(kInterpolationError, parameters_.interpolation_error_register, now());
  }
}

double EposDrive::Implementation::ramp_deceleration() const {
  return device_.ramp() == StopRamp::Profile ? profile_deceleration_ : quick_stop_deceleration_;
}

void EposDrive::Implementation::stop_at_once() {
  demand_.velocity = 0.0;
  demand_.acceleration = 0.0;
}

void EposDrive::Implementation::slow_down(double deceleration) {
  const double speed = std::abs(demand_.velocity);
  if (speed == 0.0) return;
  const double direction = demand_.velocity > 0.0 ? 1.0 : -1.0;
  if (speed <= deceleration || deceleration <= 0.0) {
    const double last_part = deceleration > 0.0 ? speed / deceleration : 0.0;
    demand_.position += 0.5 * direction * speed * last_part;
    return stop_at_once();
  }
  demand_.position += direction * (speed - 0.5 * deceleration);
  demand_.velocity -= direction * deceleration;
  demand_.acceleration = -direction * deceleration;
}

void EposDrive::Implementation::check_following_error() {
  const std::int64_t limit = objects_.get(kMaximumFollowingError);
  if (limit == kNoLimit || std::abs(demand_.position - plant_.position()) <= static_cast<double>(limit))
    return;
  if (device_.state() == DeviceState::FaultReaction) return;
  fault(kFollowingError, parameters_.motion_error_register, now());
}

void EposDrive::Implementation::watch_position_window() {
  const auto window = static_cast<double>(objects_.get(kPositionWindow));
  const bool inside = std::abs(demand_.position - plant_.position()) <= window;
  window_ms_ = inside && !ip_.active() ? window_ms_ + 1 : 0;
}

void EposDrive::Implementation::publish_motion() {
  const double actual = plant_.position();
  const std::int64_t speed = rounded(plant_.velocity() * velocity_units_);
  objects_.set(kPositionDemand, rounded(demand_.position));
  objects_.set(kPositionActual, rounded(actual));
  objects_.set(kVelocityDemand, rounded(demand_.velocity * velocity_units_));
  objects_.set(kVelocityActual, speed);
  objects_.set(kVelocitySensor, speed);
  objects_.set(kFollowingErrorActual, to_int16(demand_.position - actual));
  watch_position_window();
}

void EposDrive::Implementation::observe() {
  EposSample sample;
  sample.time = now();
  sample.samples_since_start = ip_.samples();
  sample.interpolating = interpolated_sample_;
  sample.demand = demand_.position;
  sample.velocity = demand_.velocity * kMillisecondsPerSecond;
  sample.actual = static_cast<std::int32_t>(objects_.get(kPositionActual));
  observer_(sample);
}

}  // namespace interpolated_motion::emulation
