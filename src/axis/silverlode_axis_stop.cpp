#include <string>
#include <utility>

#include "interpolated_motion_driver/axis/silverlode_axis.h"

namespace interpolated_motion::axis {

// A drive that is told to stop.

using silverlode::Outcome;

void SilverlodeAxis::stop(HostTime now) {
  delivery_->give_up();
  switch (phase_) {
    case Phase::Starting:
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
  if (!sequence_done(now)) return;
  clock_.stop();
  enter(Phase::Ready, now);
}

/// The host has found a fault while the drive may be moving: it is told to stop on its ramp.
void SilverlodeAxis::fail_in_motion(const std::string& reason, HostTime now) {
  fail(reason, now);
  clock_.stop();
  device_.request(silverlode::stp_request(device_.address(), stop_deceleration()));
}

}  // namespace interpolated_motion::axis
