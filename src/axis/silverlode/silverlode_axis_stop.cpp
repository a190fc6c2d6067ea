#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"

namespace interpolated_motion::axis {

// A drive that is told to stop.

using silverlode::Outcome;

void SilverlodeAxis::stop(HostTime now) {
  delivery_->give_up();
  withdraw_start();
  switch (phase()) {
    case Phase::Starting:
    case Phase::Verifying:
    case Phase::Moving:
      enter_phase(Phase::Braking, now);
      return start_braking(now);
    case Phase::Clearing:
    case Phase::Filling:
    case Phase::Loaded:
      enter_phase(Phase::Emptying, now);
      return sequence_.start(emptying_steps(), now);
    default:
      return;
  }
}

SilverlodeAxis::Steps SilverlodeAxis::emptying_steps() {
  Steps steps = delivery_->clear_steps();
  steps.push_back(read_rest());
  steps.push_back(read_position());
  return steps;
}

/// A ramp ends between two counts, while segments are encoded from where register 0 says that the demand
/// rests.
CommandSequence::Step SilverlodeAxis::settle_on_a_count() {
  constexpr double kSpeed = 100.0;  // counts/s, for less than a count
  const auto look = [this](const Outcome& outcome) -> std::optional<std::string> {
    const auto counts = outcome.register_value();
    if (!counts) return device_.text(outcome);
    const auto busy_or_taken = [this](const Outcome& moved) -> std::optional<std::string> {
      if (moved.accepted() || moved.refused_with(silverlode::NakCode::DeviceBusy)) return std::nullopt;
      return device_.text(moved);
    };
    sequence_.insert({{silverlode::mav_request(device_.address(), *counts, stop_deceleration(),
                                               silverlode::velocity_units(kSpeed, parameters_.command_scale)),
                       busy_or_taken},
                      await_rest(kLooksAtStop)});
    return std::nullopt;
  };
  return {silverlode::rrg_request(device_.address(), silverlode::registers::kTargetPosition), look};
}

/// STP ends the interpolated motion on a ramp; what is left in the queue goes once the drive stands.
void SilverlodeAxis::start_braking(HostTime now) {
  Steps steps{{silverlode::stp_request(device_.address(), stop_deceleration()), {}},
              await_rest(kLooksAtStop)};
  steps.push_back(settle_on_a_count());
  for (auto& step : emptying_steps()) steps.push_back(std::move(step));
  sequence_.start(std::move(steps), now);
}

void SilverlodeAxis::poll_braking(HostTime now) {
  if (sequence_.state() == CommandSequence::State::Failed) return fail(sequence_.failure(), now);
  if (sequence_.state() != CommandSequence::State::Done) return;
  clock_.stop();
  enter_phase(Phase::Ready, now);
}

/// How long the drive goes on when it hears nothing more: through all that may be in its queue, and down the
/// ramp of register 19.
HostDuration SilverlodeAxis::longest_motion(HostTime now) const {
  const double played = clock_.running() ? clock_.least_elapsed(now) : 0.0;
  const double queued = std::max(0.0, feed_.knot_end() - played) * (1.0 + parameters_.max_clock_error);
  const auto& limits = parameters_.limits;
  const double ramp = parameters_.limit_margin * limits.max_velocity / limits.max_acceleration;
  return host_duration(queued + ramp);
}

void SilverlodeAxis::press_stop(HostTime now) {
  if (sequence_.running()) return;
  const auto heard = [this](const Outcome& outcome) -> std::optional<std::string> {
    heard_stop_ = outcome.accepted() || outcome.kind == silverlode::OutcomeKind::Refused;
    return heard_stop_ ? std::nullopt : std::optional<std::string>(device_.text(outcome));
  };
  sequence_.start(
      {{silverlode::stp_request(device_.address(), stop_deceleration()), heard}, await_rest(kLooksAtFault)},
      now);
}

std::string SilverlodeAxis::unseen_text() const {
  return sequence_.running() ? "it does not answer" : sequence_.failure();
}

void SilverlodeAxis::on_fault_stopped() {
  device_.drop_requests();
  sequence_.cancel();
}

}  // namespace interpolated_motion::axis
