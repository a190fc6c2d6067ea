#include "interpolated_motion_driver/axis/silverlode/status.h"

#include "interpolated_motion_driver/protocol/silverlode/registers.h"

namespace interpolated_motion::axis {

namespace registers = silverlode::registers;
using silverlode::Outcome;
using silverlode::Request;

void SilverlodeStatus::ask(bool moving, bool multi_register, HostTime now) {
  static const std::vector<Question> moving_all{Question::PositionAndExecution, Question::Io};
  static const std::vector<Question> moving_single{Question::Position, Question::Ticks, Question::Io};
  static const std::vector<Question> resting_all{Question::PositionAndDeceleration, Question::Polling};
  static const std::vector<Question> resting_single{Question::Position, Question::Deceleration,
                                                    Question::Polling};
  const auto& questions = moving ? (multi_register ? moving_all : moving_single)
                                 : (multi_register ? resting_all : resting_single);
  question_ = questions[turn_++ % questions.size()];
  asked_ = device_.request(request_of(question_));
  asked_at_ = now;
}

void SilverlodeStatus::forget() {
  asked_ = silverlode::kNoRequest;
  refusals_ = 0;
  io = {};
  io_time = {};
  polling = {};
  underrun_deceleration.reset();
  execution.reset();
  silence.clear();
}

Request SilverlodeStatus::request_of(Question question) const {
  const std::uint8_t address = device_.address();
  switch (question) {
    case Question::Position:
      return silverlode::rrg_request(address, registers::kActualPosition);
    case Question::PositionAndDeceleration:
      return silverlode::rrg_request(address, registers::kActualPosition, registers::kImsDeceleration);
    case Question::PositionAndExecution:
      return silverlode::rrg_request(
          address, registers::kActualPosition, registers::kImsTicksLeft,
          target_in_motion_ ? registers::kTargetPosition : registers::kProfileAcceleration,
          registers::kProfileVelocity);
    case Question::Deceleration:
      return silverlode::rrg_request(address, registers::kImsDeceleration);
    case Question::Ticks:
      return silverlode::rrg_request(address, registers::kImsTicksLeft);
    case Question::Io:
      return silverlode::rio_request(address);
    case Question::Polling:
      break;
  }
  return silverlode::pol_request(address);
}

bool SilverlodeStatus::take(const Outcome& outcome) {
  if (asked_ == silverlode::kNoRequest || outcome.id != asked_) return false;
  asked_ = silverlode::kNoRequest;
  if (outcome.accepted()) take_answer(outcome);
  // A refusal may come from a question that was garbled on its way; it is an answer all the same.
  refusals_ = outcome.kind == silverlode::OutcomeKind::Refused ? refusals_ + 1 : 0;
  const bool silent = outcome.unknown() || refusals_ > kRefusals;
  silence = silent ? device_.text(outcome) : std::string();
  return true;
}

void SilverlodeStatus::take_answer(const Outcome& outcome) {
  switch (question_) {
    case Question::Position:
      return take_position(outcome);
    case Question::PositionAndDeceleration:
      take_position(outcome);
      underrun_deceleration = outcome.register_value(1);
      return;
    case Question::PositionAndExecution:
      take_position(outcome);
      return take_execution(outcome);
    case Question::Deceleration:
      underrun_deceleration = outcome.register_value(0);
      return;
    case Question::Ticks:
      execution = {outcome, outcome.register_value(0).value_or(0), {}, {}, {}, {}};
      return;
    case Question::Io:
      io.raw = outcome.word().value_or(0);
      io_time = outcome.request_end;
      return;
    case Question::Polling:
      polling.raw = outcome.polling_status().value_or(0);
      return;
  }
}

void SilverlodeStatus::take_execution(const Outcome& outcome) {
  Execution look{outcome, outcome.register_value(1).value_or(0), outcome.register_value(0), {}, {}, {}};
  (target_in_motion_ ? look.target : look.acceleration) = outcome.register_value(2);
  look.velocity = outcome.register_value(3);
  execution = look;
}

void SilverlodeStatus::take_position(const Outcome& outcome) {
  const std::optional<std::int32_t> counts = outcome.register_value(0);
  if (!counts) return;
  const double passed = seconds(outcome.request_end - feedback_.time);
  // A difference of two positions long apart would be an old velocity.
  const bool recent = passed > 0.0 && passed < 0.5;
  const double moved = static_cast<double>(*counts) - static_cast<double>(actual_counts_);
  feedback_.velocity = recent ? transmission_.joint_velocity(moved / passed) : 0.0;
  feedback_.mean_over = recent ? outcome.request_end - feedback_.time : HostDuration{};
  feedback_.position = transmission_.joint_position(*counts);
  feedback_.time = outcome.request_end;
  actual_counts_ = *counts;
}

}  // namespace interpolated_motion::axis
