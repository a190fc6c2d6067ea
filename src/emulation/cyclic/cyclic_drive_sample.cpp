#include <algorithm>
#include <cmath>

#include "cyclic_drive_implementation.h"

namespace interpolated_motion::emulation {
namespace {

// CiA 402, error codes: sync controller; following error.
constexpr std::uint16_t kSyncController = 0x8700;
constexpr std::uint16_t kFollowingError = 0x8611;

// Bits of 0x1001 (CiA 301): communication, device profile specific.
constexpr std::uint8_t kCommunicationError = 0x10;
constexpr std::uint8_t kProfileError = 0x20;

constexpr std::int64_t kNoWindow = 0xFFFFFFFF;
constexpr double kMillisecondsPerSecond = 1e3;
constexpr std::uint32_t kMostMissed = 255;

std::int64_t rounded(double value) { return static_cast<std::int64_t>(std::floor(value + 0.5)); }

}  // namespace

void CyclicDrive::Implementation::sample() {
  move();
  publish_motion();
  if (observer_) observe();
}

void CyclicDrive::Implementation::move() {
  following_error_ = false;
  fed_velocity_ = fed_acceleration_ = 0.0;
  if (!device_.power_stage()) {
    plant_.stand();
    demand_ = {plant_.position(), 0.0, 0.0};
    return;
  }
  if (device_.ramp() != StopRamp::None) {
    slow_down(ramp(device_.ramp()));
    if (demand_.velocity == 0.0) device_.at_rest();
  } else if (interpolation_.following()) {
    interpolate();
  } else {
    slow_down(ramp(StopRamp::Profile));
  }
  plant_.follow(demand_.position, fed_velocity_ * servo_ms_, fed_acceleration_ * servo_ms_ * servo_ms_);
  check_following_error();
}

void CyclicDrive::Implementation::interpolate() {
  if (interpolation_.beyond(static_cast<int>(object(0x2100, 2)), own_ms())) {
    fault(kSyncController, kCommunicationError, now());
    return slow_down(ramp(device_.ramp()));
  }
  demand_ = interpolation_.at(own_ms());
  constexpr double kPerMs = 1e-6;  // counts/s^2 to counts/ms^2
  fed_velocity_ = interpolation_.velocity_at(own_ms());
  fed_acceleration_ = interpolation_.torque_at(own_ms()) * parameters_.acceleration_per_torque * kPerMs;
}

double CyclicDrive::Implementation::ramp(StopRamp stop) const {
  if (stop == StopRamp::None) return 0.0;
  const std::int64_t per_second = object(stop == StopRamp::Profile ? 0x6084 : 0x6085, 0);
  return static_cast<double>(per_second) / (kMillisecondsPerSecond * kMillisecondsPerSecond);
}

void CyclicDrive::Implementation::slow_down(double deceleration) {
  const double speed = std::abs(demand_.velocity);
  if (speed == 0.0) return;
  const double direction = demand_.velocity > 0.0 ? 1.0 : -1.0;
  // No ramp at all: at rest at once.
  const double to_rest = deceleration > 0.0 ? speed / deceleration : 0.0;
  const double braked = std::min(to_rest, servo_ms_);
  demand_.position += direction * braked * (speed - 0.5 * deceleration * braked);
  const bool stands = to_rest <= servo_ms_;
  demand_.velocity = stands ? 0.0 : direction * (speed - deceleration * servo_ms_);
  demand_.acceleration = stands ? 0.0 : -direction * deceleration;
  // A drive that is fed forward feeds its own ramps forward too.
  if (feeds_forward_) fed_velocity_ = demand_.velocity;
}

void CyclicDrive::Implementation::check_following_error() {
  const std::int64_t window = object(0x6065, 0);
  const double error = std::abs(demand_.position - plant_.position());
  const bool outside = window != kNoWindow && error > static_cast<double>(window);
  following_error_ms_ = outside ? following_error_ms_ + servo_ms_ : 0.0;
  following_error_ = outside && following_error_ms_ > static_cast<double>(object(0x6066, 0));
  if (following_error_ && device_.state() != DeviceState::FaultReaction) {
    fault(kFollowingError, kProfileError, now());
  }
}

void CyclicDrive::Implementation::publish_motion() {
  const double actual = plant_.position();
  objects_.set(kCyclicObject<0x6062, 0>, rounded(demand_.position));
  objects_.set(kCyclicObject<0x6064, 0>, rounded(actual));
  objects_.set(kCyclicObject<0x606B, 0>, rounded(demand_.velocity * kMillisecondsPerSecond));
  objects_.set(kCyclicObject<0x606C, 0>, rounded(plant_.velocity() / servo_ms_ * kMillisecondsPerSecond));
  objects_.set(kCyclicObject<0x60F4, 0>, rounded(demand_.position - actual));
  objects_.set(kCyclicObject<0x2100, 3>, interpolation_.missed_in_all());
  objects_.set(kCyclicObject<0x2100, 4>, std::min(missed_now(), kMostMissed));
}

std::uint32_t CyclicDrive::Implementation::missed_now() const {
  return device_.in_control() ? interpolation_.missed_now(own_ms()) : 0U;
}

void CyclicDrive::Implementation::observe() const {
  CyclicSample sample;
  sample.time = now();
  sample.following = device_.in_control() && interpolation_.following();
  sample.missed = missed_now();
  sample.demand = demand_.position;
  sample.velocity = demand_.velocity * kMillisecondsPerSecond;
  sample.actual = static_cast<std::int32_t>(objects_.get(kCyclicObject<0x6064, 0>));
  observer_(sample);
}

}  // namespace interpolated_motion::emulation
