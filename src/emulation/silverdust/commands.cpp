#include "implementation.h"

// Which command does what. Numbers, classes and counts of parameters are in silverdust_command.cpp; what
// commands with parameters do is in silverdust_command_actions.cpp.
namespace interpolated_motion::emulation {
namespace {

std::uint16_t to_word(std::int64_t value) { return static_cast<std::uint16_t>(value); }

}  // namespace

SilverDust::Implementation::Answer SilverDust::Implementation::nak(NakCode code) {
  Answer answer;
  answer.kind = Answer::Kind::Nak;
  answer.code = code;
  return answer;
}

SilverDust::Implementation::Answer SilverDust::Implementation::word(std::uint16_t value, std::uint16_t echo) {
  Answer answer;
  answer.kind = Answer::Kind::Data;
  answer.echo = echo;
  answer.words[0] = value;
  answer.word_count = 1;
  return answer;
}

SilverDust::Implementation::Answer SilverDust::Implementation::bad_value() {
  if (parameters_.bad_values == BadValueReply::Nak) return nak(NakCode::BadFormat);
  polling_.raise(polling_bit::kCommandError);
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::cannot_start() {
  if (parameters_.disabled_start == DisabledStartReply::Busy) return nak(NakCode::Busy);
  polling_.raise(polling_bit::kCommandError);
  return Answer{};
}

SilverDust::Implementation::Answer SilverDust::Implementation::execute(const Packet& packet) {
  if (packet.too_long) polling_.raise(polling_bit::kTooLong);
  if (refusals_.left > 0 && packet.command == refusals_.command) {
    --refusals_.left;
    return nak(refusals_.code);
  }
  const CommandInfo* info = find_command(packet.command);
  if (!packet.well_formed) return nak(NakCode::BadFormat);
  if (info == nullptr) return nak(NakCode::BadCommand);
  const std::size_t count = packet.parameter_count;
  if (count < info->minimum_parameters || count > info->maximum_parameters) return nak(NakCode::BadFormat);
  return obey(*info, packet);
}

SilverDust::Implementation::Answer SilverDust::Implementation::obey(const CommandInfo& info,
                                                                    const Packet& packet) {
  if (info.command_class != CommandClass::Program) return immediate(info.command, packet);
  if (busy()) return nak(NakCode::Busy);
  const Answer answer = program(info.command, packet);
  const bool over = answer.kind != Answer::Kind::Nak && motion_ == Motion::None;
  if (over && parameters_.done_bit_of_short_commands) polling_.raise(polling_bit::kDone);
  return answer;
}

SilverDust::Implementation::Answer SilverDust::Implementation::immediate(Command command,
                                                                         const Packet& packet) {
  switch (command) {
    case Command::Poll: {
      const std::uint16_t status = polling_.report();
      return status == 0 ? Answer{} : word(status, 0);
    }
    case Command::PollRoutine:
      return word(polling_.report(), parameters_.por_echo);
    case Command::ClearPoll:
      return clear_poll(packet);
    case Command::Restart:
      return restart_command();
    default:
      break;
  }
  if (parameters_.immediate_done_bit) polling_.raise(polling_bit::kImmediateDone);
  switch (command) {
    case Command::Halt:
      halt();
      return Answer{};
    case Command::Stop:
      return stop(packet);
    case Command::Revision:
      return word(parameters_.revision, to_word(packet.command));
    case Command::ClearProgram:
      program_.load({});
      return Answer{};
    case Command::RunProgram:
      if (busy()) return nak(NakCode::Busy);
      program_.run();
      return Answer{};
    case Command::WriteRegister:
      return write_register(packet);
    case Command::ReadRegister:
      return read_registers(packet);
    case Command::VelocityMode:
      return velocity_mode(packet);
    case Command::ReadInternalStatus:
      return word(internal_status(), to_word(packet.command));
    case Command::ReadIo:
      return word(io_word(), to_word(packet.command));
    case Command::WriteQueue:
      return write_queue(packet);
    default:
      return nak(NakCode::BadCommand);
  }
}

SilverDust::Implementation::Answer SilverDust::Implementation::program(Command command,
                                                                       const Packet& packet) {
  switch (command) {
    case Command::MoveAbsolute:
    case Command::MoveRelative:
      return start_move(command, packet);
    case Command::InterpolatedMoveStart:
      return start_interpolation(packet);
    case Command::QueueClear:
      queue_.clear();
      return Answer{};
    case Command::ZeroTargetAndPosition:
      profile_.place(0);
      axis_.place(0.0);
      return Answer{};
    case Command::TargetToPosition:
      profile_.place(axis_.counts());
      return Answer{};
    case Command::WriteRegisterProgram:
      return write_register(packet);
    case Command::ErrorLimits:
      return set_error_limits(packet);
    case Command::Identity:
      return set_identity(packet);
    case Command::ClearInternalStatus:
      clear_internal_status();
      return Answer{};
    case Command::CheckInternalStatus:
      return check_status(packet);
    case Command::KillMotorConditions:
      return kill_conditions(packet);
    case Command::AckDelay:
      return set_ack_delay(packet);
    case Command::KillEnableDriver:
    case Command::KillDisableDriver:
      kill_keeps_driver_ = command == Command::KillEnableDriver;
      return Answer{};
    case Command::EnableDriver:
    case Command::DisableDriver:
      enabled_ = command == Command::EnableDriver;
      check_kill_conditions();
      return Answer{};
    case Command::TorqueLimits:
      return Answer{};  // the axis of the emulated drive has no torque
    default:
      return nak(NakCode::BadCommand);
  }
}

}  // namespace interpolated_motion::emulation
