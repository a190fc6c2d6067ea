#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "interpolated_motion_driver/axis/silverlode/silverlode_axis.h"

namespace interpolated_motion::axis {

namespace registers = silverlode::registers;
using silverlode::Outcome;

namespace {

constexpr std::uint16_t kAllPollingBits = 0xFFFF;
/// Kill-motor conditions in the bits of the internal status word: temperature no longer OK (bit 7 is 0),
/// moving error (bit 8 is 1).
constexpr std::uint16_t kKillMotorConditions = 0x0180;
constexpr std::uint16_t kKillMotorStates = 0x0100;
/// Servo ticks (24 ms) for which a following error may exceed its limit.
constexpr std::uint16_t kErrorDelay = 200;

CommandSequence::Check refused_is_no_failure() {
  return [](const Outcome&) { return std::optional<std::string>(); };
}

}  // namespace

std::int32_t SilverlodeAxis::underrun_deceleration() const {
  const double acceleration = parameters_.limits.max_acceleration * std::abs(counts_per_radian());
  return silverlode::ims_acceleration_units(acceleration, parameters_.command_scale);
}

std::int32_t SilverlodeAxis::stop_deceleration() const {
  const double acceleration = parameters_.limits.max_acceleration * std::abs(counts_per_radian());
  return silverlode::acceleration_units(acceleration, parameters_.command_scale);
}

double SilverlodeAxis::counts_per_radian() const { return parameters_.transmission.counts_per_radian(); }

CommandSequence::Check SilverlodeAxis::store(std::int32_t& value) const {
  return [this, &value](const Outcome& outcome) -> std::optional<std::string> {
    const auto read = outcome.register_value();
    if (!read) return device_.text(outcome);
    value = *read;
    return std::nullopt;
  };
}

CommandSequence::Step SilverlodeAxis::read_rest() {
  return {silverlode::rrg_request(device_.address(), registers::kTargetPosition), store(rest_counts_)};
}

CommandSequence::Step SilverlodeAxis::read_position() {
  return {silverlode::rrg_request(device_.address(), registers::kActualPosition),
          [this](const Outcome& outcome) -> std::optional<std::string> {
            if (!outcome.register_value()) return device_.text(outcome);
            status_.take_position(outcome);
            return std::nullopt;
          }};
}

/// Asks again until the drive has come to rest.
CommandSequence::Step SilverlodeAxis::await_rest(int looks_left) {
  return {silverlode::rio_request(device_.address()),
          [this, looks_left](const Outcome& outcome) -> std::optional<std::string> {
            if (!outcome.accepted()) return device_.text(outcome);
            status_.io.raw = outcome.word().value_or(0);
            if (!status_.io.trajectory_active()) return std::nullopt;
            if (looks_left == 0) return "the drive was told to stop but does not come to rest";
            sequence_.insert({await_rest(looks_left - 1)});
            return std::nullopt;
          }};
}

CommandSequence::Step SilverlodeAxis::check_no_fault() {
  return {silverlode::ris_request(device_.address()),
          [this](const Outcome& outcome) -> std::optional<std::string> {
            if (!outcome.accepted()) return device_.text(outcome);
            const silverlode::InternalStatus status{outcome.word().value_or(0)};
            if (!status.fault()) return std::nullopt;
            return "the drive reports: " + status.text();
          }};
}

/// Latched bits of both status words; those of the polling status word can be cleared once they have been
/// read.
SilverlodeAxis::Steps SilverlodeAxis::clear_status() {
  const std::uint8_t address = device_.address();
  return {{silverlode::cis_request(address), {}},
          {silverlode::pol_request(address), {}},
          {silverlode::cpl_request(address, kAllPollingBits), {}},
          {silverlode::pol_request(address), [this](const Outcome& outcome) -> std::optional<std::string> {
             if (!outcome.accepted()) return device_.text(outcome);
             status_.polling.raw = outcome.polling_status().value_or(0);
             return std::nullopt;
           }}};
}

SilverlodeAxis::Steps SilverlodeAxis::error_limit_steps() {
  const double most = std::numeric_limits<std::int16_t>::max();
  const double counts = std::abs(counts_per_radian()) * parameters_.max_following_error;
  const auto limit = static_cast<std::int16_t>(std::clamp(std::round(counts), 1.0, most));
  const std::uint8_t address = device_.address();
  return {{silverlode::erl_request(address, limit, limit, kErrorDelay), {}},
          {silverlode::kmc_request(address, kKillMotorConditions, kKillMotorStates), {}}};
}

// Several registers in one command are known to work from SilverDust revision 31 on.
CommandSequence::Step SilverlodeAxis::try_multi_register() {
  return {silverlode::rrg_request(device_.address(), registers::kActualPosition, registers::kImsTicksLeft),
          [this](const Outcome& outcome) -> std::optional<std::string> {
            if (outcome.unknown()) return device_.text(outcome);
            multi_register_ = outcome.register_value(1).has_value();
            return std::nullopt;
          }};
}

// A drive may come up enabled and moving from an earlier life of the host: it is stopped on its ramp first.
SilverlodeAxis::Steps SilverlodeAxis::bring_up_steps() {
  const std::uint8_t address = device_.address();
  Steps steps{
      {silverlode::stp_request(address, stop_deceleration()), refused_is_no_failure()},
      await_rest(kLooksAtStop),
      {silverlode::dmd_request(address), {}},
      {silverlode::rvn_request(address), [this](const Outcome& outcome) -> std::optional<std::string> {
         if (outcome.unknown()) return device_.text(outcome);
         revision_ = "unknown";
         if (outcome.kind == silverlode::OutcomeKind::Data) revision_.clear();
         for (std::size_t i = 0; i < outcome.word_count; ++i)
           revision_ += fmt::format("{}{:04X}", i == 0 ? "" : " ", outcome.words[i]);
         return std::nullopt;
       }}};
  const auto append = [&steps](Steps more) { steps.insert(steps.end(), more.begin(), more.end()); };
  append(clear_status());
  append({check_no_fault()});
  append(error_limit_steps());
  append(write_and_verify(device_, registers::kImsDeceleration, underrun_deceleration(),
                          "deceleration when the queue runs dry"));
  append({try_multi_register()});
  append(delivery_->bring_up_steps());
  append({read_position()});
  return steps;
}

// The target goes to where the motor stands before the driver is switched on, so that nothing moves.
SilverlodeAxis::Steps SilverlodeAxis::enable_steps() {
  const std::uint8_t address = device_.address();
  Steps steps = clear_status();
  steps.push_back({silverlode::ttp_request(address), {}});
  steps.push_back({silverlode::emd_request(address), {}});
  steps.push_back(check_no_fault());
  steps.push_back(read_rest());
  return steps;
}

}  // namespace interpolated_motion::axis
