#include <algorithm>
#include <cstdlib>

#include "implementation.h"

// The servo tick: who moves the target, how the axis follows, and what is wrong with it.
namespace interpolated_motion::emulation {

void SilverDust::Implementation::tick() {
  if (program_.running()) program_.tick(*this);
  const bool interpolating = motion_ == Motion::Interpolated;
  move();
  if (enabled_) {
    axis_.follow(profile_.position());
  } else {
    axis_.stand();
  }
  check_errors();
  if (observer_) observe(interpolating);
}

void SilverDust::Implementation::move() {
  switch (motion_) {
    case Motion::None:
      if (holding_countdown_ > 0) --holding_countdown_;
      break;
    case Motion::Interpolated:
      interpolation_.tick();
      if (!interpolation_.active()) end_motion();
      break;
    case Motion::Profile:
    case Motion::Velocity:
    case Motion::Stopping:
      profile_.tick();
      if (profile_.done()) end_motion();
      break;
  }
}

void SilverDust::Implementation::observe(bool interpolating) const {
  SilverDustSample sample;
  sample.time = tick_time(ticks_);
  sample.ticks_since_start = interpolation_.ticks();
  sample.interpolating = interpolating;
  sample.demand = profile_.position();
  sample.velocity = profile_.counts_per_tick();
  sample.actual = position();
  observer_(sample);
}

void SilverDust::Implementation::end_motion() {
  motion_ = Motion::None;
  holding_countdown_ = holding_delay_;
  polling_.raise(polling_bit::kDone);
}

// The kill motor recovery: motion and program end, the driver goes off unless KED keeps it on.
void SilverDust::Implementation::kill() {
  interpolation_.abandon();
  program_.stop();
  profile_.brake(0);
  if (motion_ != Motion::None) end_motion();
  if (!kill_keeps_driver_) enabled_ = false;
}

void SilverDust::Implementation::halt() {
  kill();
  latch(status_bit::kHalted, 0);
}

void SilverDust::Implementation::check_errors() {
  const std::int64_t error = std::abs(position_error());
  largest_error_ = std::max(largest_error_, error);
  if (!enabled_) return;
  const bool moving = motion_ != Motion::None;
  if (moving ? error > moving_limit_ : holding_countdown_ == 0 && error > holding_limit_) {
    if (moving) {
      latch(status_bit::kMovingError, polling_bit::kMovingError);
    } else {
      latch(status_bit::kHoldingError, polling_bit::kHoldingError);
    }
  }
}

void SilverDust::Implementation::latch(std::uint16_t status_bits, std::uint16_t polling_bits) {
  const bool known = (latched_status_ & status_bits) == status_bits;
  latched_status_ = static_cast<std::uint16_t>(latched_status_ | status_bits);
  if (known) return;
  polling_.raise(polling_bits);
  check_kill_conditions();
}

// KMC: one of the enabled bits of the internal status word has the chosen state.
void SilverDust::Implementation::check_kill_conditions() {
  const auto equal = static_cast<std::uint16_t>(~(internal_status() ^ kill_state_));
  const bool met = (equal & kill_enable_) != 0;
  const bool shut_down = met && (!killed_ || enabled_);
  killed_ = met;
  if (!shut_down) return;
  polling_.raise(polling_bit::kShutDown);
  kill();
}

void SilverDust::Implementation::raise_fault(SilverDustFault fault, HostTime now) {
  catch_up(now);
  if (!awake_) return;
  switch (fault) {
    case SilverDustFault::OverTemperature:
      temperature_ok_ = false;
      check_kill_conditions();
      break;
    case SilverDustFault::OverVoltage:
      latch(status_bit::kOverVoltage, polling_bit::kVoltage);
      break;
    case SilverDustFault::LowVoltage:
      latch(status_bit::kLowVoltage, polling_bit::kVoltage);
      break;
    case SilverDustFault::MovingError:
      latch(status_bit::kMovingError, polling_bit::kMovingError);
      break;
    case SilverDustFault::HoldingError:
      latch(status_bit::kHoldingError, polling_bit::kHoldingError);
      break;
  }
}

// A tick would change nothing.
bool SilverDust::Implementation::resting() const {
  if (motion_ != Motion::None || program_.running() || holding_countdown_ > 0) return false;
  return !enabled_ || axis_.settled(profile_.position());
}

std::int64_t SilverDust::Implementation::ordinary_step(std::int64_t acceleration) const {
  return profile_.scale().step(std::max<std::int64_t>(acceleration, 0), parameters_.acceleration_full_scale);
}

// Change of velocity per tick of what is running; of register 19 while a segment of constant velocity is.
std::int64_t SilverDust::Implementation::running_step() const {
  if (motion_ != Motion::Interpolated) return motion_step_;
  const std::int32_t segment = registers_.get(silverdust_register::kProfileAcceleration);
  const std::int32_t fallback = std::max(registers_.get(silverdust_register::kDefaultDeceleration), 0);
  return profile_.scale().step(segment > 0 ? segment : fallback, parameters_.ims_acceleration_full_scale);
}

void SilverDust::Implementation::program_write(std::int64_t reg, std::int32_t value) {
  const bool written = RegisterFile::writable(reg) && set_register(reg, value);
  if (!written) polling_.raise(polling_bit::kCommandError);
}

std::int32_t SilverDust::Implementation::program_read(std::int64_t reg) const {
  return RegisterFile::exists(reg) ? read_register(reg) : 0;
}

void SilverDust::Implementation::program_start_interpolation() {
  if (motion_ != Motion::None || !enabled_) return polling_.raise(polling_bit::kCommandError);
  interpolation_.start();
  motion_ = Motion::Interpolated;
}

}  // namespace interpolated_motion::emulation
