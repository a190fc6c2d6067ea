#include "interpolated_motion_driver/emulation/silverdust/interpolated_move.h"

#include <algorithm>

namespace interpolated_motion::emulation {

using namespace silverdust_register;

namespace {

constexpr std::uint32_t kTaken = 0x00010000;  // high word of register 17
constexpr std::uint32_t kHighWord = 0xFFFF0000;
constexpr std::uint32_t kLowWord = 0x0000FFFF;
constexpr std::int64_t kSegmentRegisters = 4;

}  // namespace

InterpolatedMove::InterpolatedMove(const SilverDustParameters& parameters, RegisterFile& registers,
                                   SegmentQueue& queue, ProfileGenerator& profile)
    : full_scale_(parameters.ims_acceleration_full_scale),
      registers_(registers),
      queue_(queue),
      profile_(profile) {}

void InterpolatedMove::start() {
  phase_ = Phase::Starting;
  ticks_ = -1;
}

void InterpolatedMove::tick() {
  ++ticks_;
  if (phase_ == Phase::Starting) return load();
  profile_.tick();
  if (phase_ == Phase::Running) {
    const std::int32_t left = std::max(registers_.get(kSegmentTime), 1) - 1;
    registers_.set(kSegmentTime, left);
    if (left <= 0) load();
  } else if (phase_ == Phase::LastTick) {
    profile_.brake(0);
    phase_ = Phase::Idle;
  } else if (profile_.velocity() == 0) {
    phase_ = Phase::Idle;
  }
}

void InterpolatedMove::load() {
  VelocitySegment segment;
  if (!fetch(segment)) return stop();
  ++counters_.segments_executed;
  execute(segment);
  phase_ = segment.time > 0 ? Phase::Running : Phase::LastTick;
}

bool InterpolatedMove::fetch(VelocitySegment& segment) {
  const auto control = static_cast<std::uint32_t>(registers_.get(kSegmentControl));
  const std::uint32_t first = control & kLowWord;
  if (first == 0) return fetch_queued(segment);
  return (control & kHighWord) == 0 && fetch_registers(first, segment);
}

bool InterpolatedMove::fetch_queued(VelocitySegment& segment) {
  if (!queue_.holds_end()) {
    const int fill = queue_.size();
    counters_.minimum_fill = counters_.minimum_fill < 0 ? fill : std::min(counters_.minimum_fill, fill);
  }
  if (queue_.size() == 0) return false;
  segment = queue_.pop();
  return true;
}

bool InterpolatedMove::fetch_registers(std::int64_t first, VelocitySegment& segment) {
  if (!RegisterFile::user(first, kSegmentRegisters)) return false;
  segment.time = std::max(registers_.get(first), 0);
  segment.position = registers_.get(first + 1);
  segment.acceleration = std::max(registers_.get(first + 2), 0);
  segment.velocity = std::max(registers_.get(first + 3), 0);
  registers_.set(kSegmentControl, static_cast<std::int32_t>(kTaken | static_cast<std::uint32_t>(first)));
  return true;
}

void InterpolatedMove::execute(const VelocitySegment& segment) {
  registers_.set(kSegmentTime, segment.time);
  registers_.set(kProfilePosition, segment.position);
  registers_.set(kProfileAcceleration, segment.acceleration);
  registers_.set(kProfileVelocity, segment.velocity);
  registers_.set(kProfileDeceleration, segment.acceleration);
  aim();
}

void InterpolatedMove::follow_registers() {
  if (phase_ == Phase::Running || phase_ == Phase::LastTick) aim();
}

// Registers 20..23 are what the profile generator goes by.
void InterpolatedMove::aim() {
  const std::int64_t step = step_of(kProfileAcceleration);
  const std::int64_t braking = step_of(kProfileDeceleration);
  profile_.move_to(registers_.get(kProfilePosition), {step, braking > 0 ? braking : step},
                   std::max(registers_.get(kProfileVelocity), 0));
}

std::int64_t InterpolatedMove::step_of(std::int64_t number) const {
  return profile_.scale().step(std::max(registers_.get(number), 0), full_scale_);
}

void InterpolatedMove::stop() {
  ++counters_.underruns;
  profile_.brake(default_step());
  phase_ = profile_.velocity() == 0 ? Phase::Idle : Phase::Stopping;
}

std::int64_t InterpolatedMove::step() const {
  const std::int32_t acceleration = registers_.get(kProfileAcceleration);
  return acceleration > 0 ? profile_.scale().step(acceleration, full_scale_) : default_step();
}

std::int64_t InterpolatedMove::default_step() const { return step_of(kDefaultDeceleration); }

}  // namespace interpolated_motion::emulation
