#include "interpolated_motion_driver/emulation/epos/interpolated_position_mode.h"

#include <cmath>

namespace interpolated_motion::emulation {
namespace {

// Bits of 0x20C4:1 ("EPOS3 Interpolated Position Mode", table 4-35).
constexpr std::uint16_t kUnderflowWarning = 1U << 0;
constexpr std::uint16_t kOverflowWarning = 1U << 1;
constexpr std::uint16_t kVelocityWarning = 1U << 2;
constexpr std::uint16_t kAccelerationWarning = 1U << 3;
constexpr std::uint16_t kUnderflowError = 1U << 8;
constexpr std::uint16_t kOverflowError = 1U << 9;
constexpr std::uint16_t kVelocityError = 1U << 10;
constexpr std::uint16_t kAccelerationError = 1U << 11;
constexpr std::uint16_t kBufferEnabled = 1U << 14;
constexpr std::uint16_t kActive = 1U << 15;

constexpr int kFewest = 2;  // "at least two data records have to be in the FIFO", 4.3.6.1

// Room for the rounding of the cubic's own arithmetic, so that a motion exactly at a limit does not exceed
// it.
constexpr double kRounding = 1.0 + 1e-9;

bool exceeds(double value, double limit) { return std::abs(value) > limit * kRounding; }

}  // namespace

void InterpolatedPositionMode::reset() {
  clear();
  access_ = false;
  active_ = false;
  errors_ = 0;
}

void InterpolatedPositionMode::clear() {
  buffer_.clear();
  target_queued_ = false;
  warnings_ = 0;
  if (parameters_.error_bits_clear == ErrorBitsClear::AtBufferClear) errors_ = 0;
}

void InterpolatedPositionMode::enable_access(bool enabled) {
  if (!enabled) clear();
  access_ = enabled;
}

void InterpolatedPositionMode::on_fault_reset() {
  if (parameters_.error_bits_clear == ErrorBitsClear::AtFaultReset) errors_ = 0;
}

InterpolationEvent InterpolatedPositionMode::push(const BufferedRecord& record) {
  if (buffer_.full()) return overflow();
  const bool moving = record.time != 0;
  const bool outside =
      record.position < limits_.lowest_position || record.position > limits_.highest_position;
  if (moving && outside && parameters_.position_limit_check == PositionLimitCheck::PerRecord) {
    return InterpolationEvent::PositionLimit;
  }
  buffer_.push(record);
  return InterpolationEvent::None;
}

InterpolationEvent InterpolatedPositionMode::overflow() {
  ++overflows_;
  if (!active_ && parameters_.overflow_while_inactive == InactiveOverflow::Drop)
    return InterpolationEvent::None;
  errors_ |= kOverflowError;
  const bool fault = active_ || parameters_.overflow_while_inactive == InactiveOverflow::Fault;
  return fault ? InterpolationEvent::Overflow : InterpolationEvent::None;
}

InterpolationEvent InterpolatedPositionMode::underflow() {
  ++underflows_;
  errors_ |= kUnderflowError;
  active_ = false;
  return InterpolationEvent::Underflow;
}

InterpolationEvent InterpolatedPositionMode::start(double demand) {
  if (!buffer_.empty() && buffer_.front().time == 0) {
    switch (parameters_.leading_terminator) {
      case LeadingTerminator::Fault:
        return underflow();
      case LeadingTerminator::EndsMode:
        buffer_.pop();
        return InterpolationEvent::Ended;
      case LeadingTerminator::Skipped:
        while (!buffer_.empty() && buffer_.front().time == 0) buffer_.pop();
    }
  }
  if (buffer_.size() < kFewest) {
    return parameters_.short_start == ShortStart::Fault ? underflow() : InterpolationEvent::None;
  }
  active_ = true;
  samples_ = 0;
  target_queued_ = false;
  note_fill();
  return next_segment({demand, 0.0, 0.0});
}

InterpolationEvent InterpolatedPositionMode::next_segment(const MotionState& from) {
  if (buffer_.empty()) return underflow();
  const BufferedRecord record = buffer_.front();
  if (record.time == 0) {
    buffer_.pop();
    active_ = false;
    return InterpolationEvent::Ended;
  }
  target_queued_ = parameters_.record_release == RecordRelease::AtSegmentEnd;
  if (!target_queued_) buffer_.pop();
  aim_at(from, record);
  return parameters_.motion_check == MotionCheck::Knots ? check_knots() : InterpolationEvent::None;
}

void InterpolatedPositionMode::aim_at(const MotionState& from, const BufferedRecord& record) {
  const MotionState target{static_cast<double>(record.position), record.velocity * limits_.velocity_unit,
                           0.0};
  duration_ = record.time;
  elapsed_ = 0;
  segment_ = SplineSegment(from, target, duration_);
  target_ = target;
}

void InterpolatedPositionMode::resume(double demand) {
  elapsed_ = 0;
  segment_ = SplineSegment({demand, 0.0, 0.0}, target_, duration_);
}

InterpolationEvent InterpolatedPositionMode::sample(MotionState& state) {
  ++elapsed_;
  ++samples_;
  state = segment_.at(elapsed_);
  InterpolationEvent event = check_demand(state);
  if (event == InterpolationEvent::None && elapsed_ == duration_) event = finish_segment();
  if (is_error(event)) active_ = false;
  if (event == InterpolationEvent::Ended) state.velocity = state.acceleration = 0.0;
  if (active_) note_fill();
  return event;
}

InterpolationEvent InterpolatedPositionMode::finish_segment() {
  if (target_queued_) buffer_.pop();
  target_queued_ = false;
  return next_segment(target_);
}

InterpolationEvent InterpolatedPositionMode::check_demand(const MotionState& state) {
  if (parameters_.underflow_test == UnderflowTest::EverySample && buffer_.size() < kFewest &&
      !buffer_.terminated()) {
    return underflow();
  }
  const bool outside = state.position < limits_.lowest_position || state.position > limits_.highest_position;
  if (outside && parameters_.position_limit_check == PositionLimitCheck::RunTime) {
    return InterpolationEvent::PositionLimit;
  }
  return parameters_.motion_check == MotionCheck::Samples ? check_motion(state) : InterpolationEvent::None;
}

InterpolationEvent InterpolatedPositionMode::check_knots() {
  const InterpolationEvent event = check_motion(segment_.at(0.0));
  return event != InterpolationEvent::None ? event : check_motion(segment_.at(segment_.duration()));
}

InterpolationEvent InterpolatedPositionMode::check_motion(const MotionState& state) {
  if (!parameters_.motion_warnings_latched) warnings_ = 0;
  if (exceeds(state.velocity, limits_.velocity_warning)) warnings_ |= kVelocityWarning;
  if (exceeds(state.acceleration, limits_.acceleration_warning)) warnings_ |= kAccelerationWarning;
  const bool velocity = exceeds(state.velocity, limits_.velocity_error);
  const bool acceleration = exceeds(state.acceleration, limits_.acceleration_error);
  if (velocity) errors_ |= kVelocityError;
  if (acceleration) errors_ |= kAccelerationError;
  if (velocity) return InterpolationEvent::VelocityError;
  return acceleration ? InterpolationEvent::AccelerationError : InterpolationEvent::None;
}

void InterpolatedPositionMode::note_fill() {
  if (buffer_.terminated()) return;
  if (minimum_fill_ < 0 || buffer_.size() < minimum_fill_) minimum_fill_ = buffer_.size();
}

std::uint16_t InterpolatedPositionMode::status() const {
  std::uint16_t status = errors_ | warnings_;
  if (access_ || parameters_.fill_warnings_while_disabled) {
    if (buffer_.size() < limits_.underflow_level) status |= kUnderflowWarning;
    if (buffer_.size() > limits_.overflow_level) status |= kOverflowWarning;
  }
  if (access_) status |= kBufferEnabled;
  if (active_) status |= kActive;
  return status;
}

}  // namespace interpolated_motion::emulation
