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
  switch (phase_) {
    case Phase::Starting:
    case Phase::Verifying:
    case Phase::Moving:
      enter(Phase::Braking, now);
      return start_braking(now);
    case Phase::Clearing:
    case Phase::Filling:
    case Phase::Loaded:
      enter(Phase::Emptying, now);
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
  if (sequence_.state() == CommandSequence::State::Failed) return fail_in_motion(sequence_.failure(), now);
  if (sequence_.state() != CommandSequence::State::Done) return;
  clock_.stop();
  enter(Phase::Ready, now);
}

/// The host has found a fault while the drive may be moving. The axis is in fault for the group at once, but
/// not at rest before the drive stands.
void SilverlodeAxis::fail_in_motion(const std::string& reason, HostTime now) {
  fail(reason, now);
  rest_due_ = now + longest_motion(now);
  heard_stop_ = false;
  clock_.stop();
  enter(Phase::FaultBraking, now);
  start_fault_braking(now);
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

void SilverlodeAxis::start_fault_braking(HostTime now) {
  const auto heard = [this](const Outcome& outcome) -> std::optional<std::string> {
    heard_stop_ = outcome.accepted() || outcome.kind == silverlode::OutcomeKind::Refused;
    return heard_stop_ ? std::nullopt : std::optional<std::string>(device_.text(outcome));
  };
  sequence_.start(
      {{silverlode::stp_request(device_.address(), stop_deceleration()), heard}, await_rest(kLooksAtFault)},
      now);
}

/// A drive that does not answer is told again until its queue must be over and it has braked by itself.
void SilverlodeAxis::poll_fault_braking(HostTime now) {
  const bool waits = heard_stop_ || now < rest_due_;
  if (sequence_.running() && waits) return;
  const bool stands = sequence_.state() == CommandSequence::State::Done;
  if (!stands && now < rest_due_) return start_fault_braking(now);
  if (stands) {
    fault_text_ += " The drive has come to rest.";
  } else {
    fault_text_ += fmt::format(
        " The drive has not been seen at rest ({}); {:.1f} s after the fault its queue is over, and it has "
        "braked by itself if it still works.",
        sequence_.running() ? "it does not answer" : sequence_.failure(), seconds(now - phase_since_));
  }
  device_.drop_requests();
  sequence_.cancel();
  enter(Phase::Fault, now);
}

}  // namespace interpolated_motion::axis
