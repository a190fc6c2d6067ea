#include "interpolated_motion_driver/emulation/canopen/motion_clock.h"

#include <algorithm>
#include <cmath>

namespace interpolated_motion::emulation {
namespace {

constexpr double kMicrosecond = 1e3;

}  // namespace

MotionClock::MotionClock(const MotionClockSettings& settings, HostTime now)
    : settings_(settings),
      period_(static_cast<double>(settings.sample_period.count())),
      crystal_(settings.error_ppm, now),
      next_sample_(now) {}

void MotionClock::restart(HostTime first) {
  crystal_.restart(first);
  samples_ = 0;
  correction_ = wanted_correction_ = reference_ = 0.0;
  forget_reference();
  schedule();
}

void MotionClock::schedule() {
  next_sample_ = crystal_.time_of(static_cast<double>(samples_) * period_ - correction_);
}

double MotionClock::samples_at(HostTime when) const {
  return 1.0 + (crystal_.count(when) + correction_) / period_;
}

void MotionClock::take_sample() {
  ++samples_;
  const auto slew = static_cast<double>(settings_.slew.count());
  correction_ += std::clamp(wanted_correction_ - correction_, -slew, slew);
  schedule();
}

void MotionClock::forget_reference() {
  has_reference_ = false;
  latched_ = false;
  wanted_correction_ = correction_;
}

void MotionClock::start_over(HostTime when) {
  forget_reference();
  reference_ = -(crystal_.count(when) + correction_);
  has_reference_ = true;
}

void MotionClock::latch(HostTime when) {
  latched_ = true;
  latched_count_ = crystal_.count(when);
  latched_correction_ = correction_;
}

std::uint32_t MotionClock::latched_microseconds() const {
  const double clock = latched_count_ + latched_correction_ + reference_;
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(clock / kMicrosecond)));
}

void MotionClock::take_time_stamp(std::uint32_t microseconds) {
  if (!settings_.discipline || !latched_) return;
  latched_ = false;
  // Both count modulo 2^32 us: so does their difference, and the shorter way round is meant.
  const double difference =
      static_cast<double>(static_cast<std::int32_t>(microseconds - latched_microseconds())) * kMicrosecond;
  if (has_reference_) {
    wanted_correction_ = latched_correction_ + difference;
  } else {
    reference_ += difference;
    has_reference_ = true;
  }
}

}  // namespace interpolated_motion::emulation
