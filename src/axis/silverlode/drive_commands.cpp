#include "interpolated_motion_driver/axis/silverlode/drive_commands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/segment_delivery.h"
#include "interpolated_motion_driver/protocol/silverlode/registers.h"
#include "interpolated_motion_driver/protocol/silverlode/request.h"

namespace interpolated_motion::axis {

namespace registers = silverlode::registers;
using silverlode::Outcome;
using Failure = std::optional<std::string>;

namespace {

/// Kill-motor conditions in the bits of the internal status word: temperature no longer OK (bit 7 is 0),
/// moving error (bit 8 is 1).
constexpr std::uint16_t kKillMotorConditions = 0x0180;
constexpr std::uint16_t kKillMotorStates = 0x0100;
/// Servo ticks (24 ms) for which a following error may exceed its limit.
constexpr std::uint16_t kErrorDelay = 200;

Failure refused_is_no_failure(const Outcome&) { return std::nullopt; }

void append(DriveCommands::Steps& steps, const DriveCommands::Steps& more) {
  steps.insert(steps.end(), more.begin(), more.end());
}

}  // namespace

double DriveCommands::counts_per_second2() const {
  return parameters_.limits.max_acceleration * std::abs(parameters_.transmission.counts_per_radian());
}

std::int32_t DriveCommands::underrun_deceleration() const {
  return silverlode::ims_acceleration_units(counts_per_second2(), parameters_.command_scale);
}

std::int32_t DriveCommands::stop_deceleration() const {
  return silverlode::acceleration_units(counts_per_second2(), parameters_.command_scale);
}

DriveCommands::Step DriveCommands::stop(CommandSequence::Check check) {
  return {silverlode::stp_request(device_.address(), stop_deceleration()), std::move(check)};
}

DriveCommands::Step DriveCommands::read(std::uint16_t number, std::int32_t& value) const {
  return {silverlode::rrg_request(device_.address(), number),
          [this, &value](const Outcome& outcome) -> Failure {
            const auto read = outcome.register_value();
            if (!read) return device_.text(outcome);
            value = *read;
            return std::nullopt;
          }};
}

DriveCommands::Step DriveCommands::read_position() {
  return {silverlode::rrg_request(device_.address(), registers::kActualPosition),
          [this](const Outcome& outcome) -> Failure {
            if (!outcome.register_value()) return device_.text(outcome);
            status_.take_position(outcome);
            return std::nullopt;
          }};
}

DriveCommands::Step DriveCommands::await_rest(int looks_left) {
  return {silverlode::rio_request(device_.address()), [this, looks_left](const Outcome& outcome) -> Failure {
            if (!outcome.accepted()) return device_.text(outcome);
            status_.io.raw = outcome.word().value_or(0);
            if (!status_.io.trajectory_active()) return std::nullopt;
            if (looks_left == 0) return "the drive was told to stop but does not come to rest";
            sequence_.insert({await_rest(looks_left - 1)});
            return std::nullopt;
          }};
}

/// `look` is for a drive that has answered.
DriveCommands::Step DriveCommands::read_polling_status(const CommandSequence::Check& look) {
  return {silverlode::pol_request(device_.address()), [this, look](const Outcome& outcome) -> Failure {
            if (!outcome.accepted()) return device_.text(outcome);
            status_.polling.raw = outcome.polling_status().value_or(0);
            return look(outcome);
          }};
}

DriveCommands::Step DriveCommands::read_internal_status(const CommandSequence::Check& look) {
  return {silverlode::ris_request(device_.address()), [this, look](const Outcome& outcome) -> Failure {
            return outcome.accepted() ? look(outcome) : device_.text(outcome);
          }};
}

DriveCommands::Step DriveCommands::read_faults() {
  return read_polling_status([](const Outcome&) -> Failure { return std::nullopt; });
}

DriveCommands::Steps DriveCommands::require_no_fault() {
  const auto look_at_polling = [this](const Outcome&) -> Failure {
    const silverlode::PollingStatus status = status_.polling;
    if (status.fault()) return "the drive reports: " + status.text();
    if (status.raw != 0) sequence_.insert({{silverlode::cpl_request(device_.address(), status.raw), {}}});
    status_.polling.raw = 0;
    return std::nullopt;
  };
  const auto look_at_internal = [](const Outcome& outcome) -> Failure {
    const silverlode::InternalStatus status{outcome.word().value_or(0)};
    return status.fault() ? Failure("the drive reports: " + status.text()) : std::nullopt;
  };
  return {read_polling_status(look_at_polling), read_internal_status(look_at_internal)};
}

// Bits of the polling status word can be cleared once they have been read; CIS clears whatever is latched.
DriveCommands::Steps DriveCommands::read_and_clear_status(SilverlodeFacts& facts) {
  const auto clear_polling = [this, &facts](const Outcome&) -> Failure {
    const silverlode::PollingStatus status = status_.polling;
    facts.found_fault = status.fault() ? status.text() : std::string();
    sequence_.insert({{silverlode::cpl_request(device_.address(), status.raw), {}}});
    return std::nullopt;
  };
  const auto clear_internal = [this, &facts](const Outcome& outcome) -> Failure {
    const silverlode::InternalStatus status{outcome.word().value_or(0)};
    if (status.fault()) facts.found_fault += (facts.found_fault.empty() ? "" : "; ") + status.text();
    sequence_.insert({{silverlode::cis_request(device_.address()), {}}});
    return std::nullopt;
  };
  return {read_polling_status(clear_polling), read_internal_status(clear_internal)};
}

DriveCommands::Steps DriveCommands::error_limits() {
  const double most = std::numeric_limits<std::int16_t>::max();
  const double counts =
      std::abs(parameters_.transmission.counts_per_radian()) * parameters_.max_following_error;
  const auto limit = static_cast<std::int16_t>(std::clamp(std::round(counts), 1.0, most));
  const std::uint8_t address = device_.address();
  return {{silverlode::erl_request(address, limit, limit, kErrorDelay), {}},
          {silverlode::kmc_request(address, kKillMotorConditions, kKillMotorStates), {}}};
}

// Several registers in one command are known to work from SilverDust revision 31 on.
DriveCommands::Step DriveCommands::try_multi_register(SilverlodeFacts& facts) {
  return {silverlode::rrg_request(device_.address(), registers::kActualPosition, registers::kImsTicksLeft),
          [this, &facts](const Outcome& outcome) -> Failure {
            if (outcome.unknown()) return device_.text(outcome);
            facts.multi_register = outcome.register_value(1).has_value();
            return std::nullopt;
          }};
}

DriveCommands::Step DriveCommands::ask_revision(SilverlodeFacts& facts) {
  return {silverlode::rvn_request(device_.address()), [this, &facts](const Outcome& outcome) -> Failure {
            if (outcome.unknown()) return device_.text(outcome);
            facts.revision = "unknown";
            if (outcome.kind == silverlode::OutcomeKind::Data) facts.revision.clear();
            for (std::size_t i = 0; i < outcome.word_count; ++i)
              facts.revision += fmt::format("{}{:04X}", i == 0 ? "" : " ", outcome.words[i]);
            return std::nullopt;
          }};
}

// A drive may come up enabled and moving from an earlier life of the host: it is stopped on its ramp first.
DriveCommands::Steps DriveCommands::bring_up(const Steps& queue, SilverlodeFacts& facts) {
  Steps steps{stop(refused_is_no_failure),
              await_rest(kLooksAtStop),
              {silverlode::dmd_request(device_.address()), {}},
              ask_revision(facts)};
  append(steps, read_and_clear_status(facts));
  append(steps, require_no_fault());
  append(steps, error_limits());
  append(steps, write_and_verify(device_, registers::kImsDeceleration, underrun_deceleration(),
                                 "deceleration when the queue runs dry"));
  steps.push_back(try_multi_register(facts));
  append(steps, queue);
  steps.push_back(read_position());
  return steps;
}

DriveCommands::Steps DriveCommands::enable() {
  const std::uint8_t address = device_.address();
  Steps steps = require_no_fault();
  steps.push_back({silverlode::ttp_request(address), {}});
  steps.push_back({silverlode::emd_request(address), {}});
  append(steps, require_no_fault());
  return steps;
}

DriveCommands::Steps DriveCommands::disable() { return {{silverlode::dmd_request(device_.address()), {}}}; }

DriveCommands::Steps DriveCommands::empty(const Steps& clear_queue, std::int32_t& rest) {
  Steps steps = clear_queue;
  steps.push_back(read(registers::kTargetPosition, rest));
  steps.push_back(read_position());
  return steps;
}

DriveCommands::Steps DriveCommands::brake(const Steps& clear_queue, std::int32_t& rest) {
  Steps steps{stop({}), await_rest(kLooksAtStop), settle_on_a_count()};
  append(steps, empty(clear_queue, rest));
  return steps;
}

/// A ramp ends between two counts, while segments are encoded from where register 0 says that the demand
/// rests.
DriveCommands::Step DriveCommands::settle_on_a_count() {
  constexpr double kSpeed = 100.0;  // counts/s, for less than a count
  const auto look = [this](const Outcome& outcome) -> Failure {
    const auto counts = outcome.register_value();
    if (!counts) return device_.text(outcome);
    const auto busy_or_taken = [this](const Outcome& moved) -> Failure {
      if (moved.accepted() || moved.refused_with(silverlode::NakCode::DeviceBusy)) return std::nullopt;
      return device_.text(moved);
    };
    sequence_.insert({{silverlode::mav_request(device_.address(), *counts, stop_deceleration(),
                                               silverlode::velocity_units(kSpeed, parameters_.command_scale)),
                       busy_or_taken},
                      await_rest(kLooksAtStop)});
    return std::nullopt;
  };
  return {silverlode::rrg_request(device_.address(), registers::kTargetPosition), look};
}

}  // namespace interpolated_motion::axis
