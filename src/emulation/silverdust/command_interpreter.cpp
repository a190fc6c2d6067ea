#include "interpolated_motion_driver/emulation/silverdust/command_interpreter.h"

namespace interpolated_motion::emulation {

CommandInterpreter::CommandInterpreter(const SilverDustParameters& parameters, PollingStatus& polling,
                                       const MotionControl& motion, const StoredProgram& program,
                                       const CommandRouter& commands)
    : parameters_(parameters), polling_(polling), motion_(motion), program_(program), commands_(commands) {}

Answer CommandInterpreter::execute(const Packet& packet) {
  ++executed_;
  if (packet.too_long) polling_.raise(polling_bit::kTooLong);
  if (refuses(packet)) return Answer::nak(refusals_.code);
  if (!packet.well_formed) return Answer::nak(NakCode::BadFormat);
  const CommandInfo* info = find_command(packet.command);
  if (info == nullptr) return Answer::nak(NakCode::BadCommand);
  const std::size_t count = packet.parameter_count;
  if (count < info->minimum_parameters || count > info->maximum_parameters)
    return Answer::nak(NakCode::BadFormat);
  return info->command_class == CommandClass::Program ? obey_program_class(*info, packet)
                                                      : obey_immediate(*info, packet);
}

bool CommandInterpreter::refuses(const Packet& packet) {
  if (refusals_.left <= 0 || packet.command != refusals_.command) return false;
  --refusals_.left;
  return true;
}

Answer CommandInterpreter::obey_program_class(const CommandInfo& info, const Packet& packet) {
  if (busy()) return Answer::nak(NakCode::Busy);
  const Answer answer = settled(commands_.obey(info, packet));
  const bool over = !answer.refused() && !motion_.active();
  if (over && parameters_.done_bit_of_short_commands) polling_.raise(polling_bit::kDone);
  return answer;
}

Answer CommandInterpreter::obey_immediate(const CommandInfo& info, const Packet& packet) {
  const bool polls = info.chapter == CommandChapter::Polling;
  if (!polls && parameters_.immediate_done_bit) polling_.raise(polling_bit::kImmediateDone);
  return settled(commands_.obey(info, packet));
}

// What is said where the documents leave it open, and bit 12 of the polling status word.
Answer CommandInterpreter::settled(const Answer& answer) {
  switch (answer.kind()) {
    case Answer::Kind::BadValue:
      if (parameters_.replies.bad_values == BadValueReply::Nak) return Answer::nak(NakCode::BadFormat);
      break;
    case Answer::Kind::CannotStart:
      if (parameters_.replies.disabled_start == DisabledStartReply::Busy) return Answer::nak(NakCode::Busy);
      break;
    case Answer::Kind::CommandError:
      break;
    default:
      return answer;
  }
  polling_.raise(polling_bit::kCommandError);
  return Answer{};
}

}  // namespace interpolated_motion::emulation
