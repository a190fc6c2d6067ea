#include "interpolation/cip_interpolator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace interpolated_motion::interpolation {
namespace {

constexpr int kMostMissedUpdates = 1000;

int highest_order(CipCommand command) {
  switch (command) {
    case CipCommand::Position:
      return 3;
    case CipCommand::Velocity:
      return 2;
    case CipCommand::Acceleration:
      return 1;
  }
  return 1;
}

template <class Value>
void require(bool valid, const char* name, const Value& value, const char* range) {
  if (!valid) {
    throw std::invalid_argument(
        fmt::format("fine interpolator: {} is {}, allowed is {}", name, value, range));
  }
}

/// Braking from a rate at a constant deceleration, `elapsed` s after its begin.
CipSample brake(double value, double rate, double deceleration, double elapsed) {
  const double duration = std::abs(rate) / deceleration;
  if (elapsed >= duration) return {value + rate * duration / 2, 0.0, 0.0};
  const double slope = rate > 0 ? -deceleration : deceleration;
  return {value + elapsed * (rate + elapsed * slope / 2), rate + elapsed * slope, slope};
}

}  // namespace

void validate(const CipParameters& p) {
  constexpr const char* kOrders[] = {"", "1", "1..2", "1..3"};
  const int highest = highest_order(p.command);
  require(p.order >= 1 && p.order <= highest, "order", p.order, kOrders[highest]);
  require(p.period > HostDuration::zero(), "period", p.period.count(), "1 ns or more");
  require(p.missed_updates >= 0 && p.missed_updates <= kMostMissedUpdates, "missed_updates", p.missed_updates,
          "0..1000");
  require(p.deceleration > 0.0 && std::isfinite(p.deceleration), "deceleration", p.deceleration,
          "a finite number above 0");
  require(p.blend >= HostDuration::zero(), "blend", p.blend.count(), "0 ns or more");
}

CipInterpolator::CipInterpolator(const CipParameters& parameters) : parameters_(parameters) {
  validate(parameters_);
}

void CipInterpolator::reset(double value) {
  held_ = value;
  count_ = 0;
  blend_.reset();
  stop_.reset();
  last_step_ = {};
}

CipPush CipInterpolator::push(SystemTime stamp, double value, HostTime now) {
  const SystemTime t = offset_.system(now);
  stop_if_due(t);
  if (stop_) return CipPush::Stopped;
  if (count_ == 0 && t > stop_time(stamp)) return CipPush::Outdated;
  const CipSample raw_before = on_polynomial(t);
  const CipSample before = output(t);
  if (count_ == 0) start_at_rest(stamp);
  const CipPush result = insert({stamp, value}, t);
  note_step(raw_before, before, t);
  return result;
}

CipPush CipInterpolator::insert(const Command& command, SystemTime t) {
  const auto end = commands_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto place = std::lower_bound(commands_.begin(), end, command.stamp,
                                      [](const Command& c, SystemTime s) { return c.stamp < s; });
  if (place == commands_.begin() || (place != end && place->stamp == command.stamp)) return CipPush::Outdated;
  const bool is_newest = place == end;
  const SystemTime t0 = (place - 1)->stamp;
  std::move_backward(place, end, end + 1);
  *place = command;
  ++count_;
  if (count_ > kCommands) {
    // The oldest leaves unless the polynomial in effect still needs it.
    const bool needed = segment_end(t) <= static_cast<std::size_t>(parameters_.order);
    const auto leaves = needed ? place : commands_.begin();
    std::move(leaves + 1, commands_.begin() + static_cast<std::ptrdiff_t>(count_), leaves);
    --count_;
    if (needed) return CipPush::Full;
  }
  if (!is_newest) return CipPush::Filled;
  return t < t0 ? CipPush::Pending : CipPush::Applied;
}

void CipInterpolator::start_at_rest(SystemTime stamp) {
  for (std::size_t back = kCipHighestOrder; back >= 1; --back) {
    const auto periods = static_cast<HostDuration::rep>(back);
    commands_[count_++] = {stamp - periods * parameters_.period, held_};
  }
  motion_begin_ = stamp - parameters_.period;
}

void CipInterpolator::note_step(const CipSample& raw_before, const CipSample& before, SystemTime t) {
  const CipSample after = on_polynomial(t);
  const CipStep step{after.value - raw_before.value, after.first_derivative - raw_before.first_derivative};
  if (step.value == 0.0 && step.first_derivative == 0.0) return;
  last_step_ = step;
  if (parameters_.blend == HostDuration::zero()) return;
  const HermiteKnot gap{before.value - after.value, before.first_derivative - after.first_derivative};
  blend_ = Blend{t, CubicHermite(gap, HermiteKnot{}, seconds(parameters_.blend))};
}

CipSample CipInterpolator::sample(HostTime now) {
  const SystemTime t = offset_.system(now);
  stop_if_due(t);
  return stop_ ? stopping(t) : output(t);
}

CipState CipInterpolator::state(HostTime now) {
  const SystemTime t = offset_.system(now);
  stop_if_due(t);
  if (stop_) return at_rest(t) ? CipState::Stopped : CipState::Stopping;
  if (count_ == 0 || t < motion_begin_) return CipState::Holding;
  return t > newest().stamp ? CipState::Extrapolating : CipState::Interpolating;
}

HostDuration CipInterpolator::extrapolated(HostTime now) const {
  if (count_ == 0) return HostDuration::zero();
  return std::max(HostDuration::zero(), offset_.system(now) - newest().stamp);
}

std::size_t CipInterpolator::segment_end(SystemTime t) const {
  std::size_t end = 1;
  while (end + 1 < count_ && commands_[end].stamp <= t) ++end;
  return end;
}

CipSample CipInterpolator::on_polynomial(SystemTime t) const {
  if (count_ == 0) return {held_, 0.0, 0.0};
  const std::size_t end = segment_end(t);
  const int order = std::min(parameters_.order, static_cast<int>(end));
  const SystemTime t0 = commands_[end - 1].stamp;
  CipKnots knots;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(order); ++i) {
    const Command& command = commands_[end - i];
    knots[i] = {seconds(command.stamp - t0), command.value};
  }
  const CipPolynomial p = cip_polynomial_through(order, knots);
  const double tau = seconds(t - t0);
  return {p.value(tau), p.first_derivative(tau), p.second_derivative(tau)};
}

CipSample CipInterpolator::output(SystemTime t) const {
  CipSample sample = on_polynomial(t);
  if (!blend_ || t - blend_->begin >= parameters_.blend) return sample;
  const double s = seconds(t - blend_->begin) - blend_->correction.duration();
  sample.value += blend_->correction.position(s);
  sample.first_derivative += blend_->correction.velocity(s);
  sample.second_derivative += blend_->correction.acceleration(s);
  return sample;
}

SystemTime CipInterpolator::stop_time(SystemTime stamp) const {
  return stamp + parameters_.missed_updates * parameters_.period;
}

void CipInterpolator::stop_if_due(SystemTime t) {
  if (stop_ || count_ == 0) return;
  const SystemTime begin = stop_time(newest().stamp);
  if (t > begin) stop_ = Stop{begin, output(begin)};
}

CipSample CipInterpolator::stopping(SystemTime t) const {
  const double elapsed = seconds(t - stop_->begin);
  const CipSample& from = stop_->from;
  switch (parameters_.command) {
    case CipCommand::Position:
      return brake(from.value, from.first_derivative, parameters_.deceleration, elapsed);
    case CipCommand::Velocity: {
      const CipSample level = brake(0.0, from.value, parameters_.deceleration, elapsed);
      return {level.first_derivative, level.second_derivative, 0.0};
    }
    case CipCommand::Acceleration:
      break;
  }
  return {};
}

bool CipInterpolator::at_rest(SystemTime t) const {
  const CipSample sample = stopping(t);
  const bool moves =
      parameters_.command == CipCommand::Position ? sample.first_derivative != 0.0 : sample.value != 0.0;
  return !moves;
}

}  // namespace interpolated_motion::interpolation
