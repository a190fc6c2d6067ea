#include "interpolated_motion_driver/emulation/silverdust/program_commands.h"

namespace interpolated_motion::emulation {

Answer ProgramCommands::obey(Command command) {
  switch (command) {
    case Command::ClearProgram:
      return clear();
    case Command::RunProgram:
      return run();
    default:
      return Answer::nak(NakCode::BadCommand);
  }
}

Answer ProgramCommands::clear() {
  program_.load({});
  return Answer{};
}

// Immediate, yet it does not take over what runs.
Answer ProgramCommands::run() {
  if (program_.running() || motion_.active()) return Answer::nak(NakCode::Busy);
  program_.run();
  return Answer{};
}

}  // namespace interpolated_motion::emulation
