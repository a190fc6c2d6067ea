#include "interpolated_motion_driver/emulation/silverdust/command_router.h"

namespace interpolated_motion::emulation {

CommandRouter::CommandRouter(const CommunicationCommands& communication, const PollingCommands& polling,
                             const StatusCommands& status, const RegisterCommands& registers,
                             const MotionCommands& motion, const InterpolationCommands& interpolation,
                             const ProtectionCommands& protection, const ProgramCommands& program)
    : communication_(communication),
      polling_(polling),
      status_(status),
      registers_(registers),
      motion_(motion),
      interpolation_(interpolation),
      protection_(protection),
      program_(program) {}

Answer CommandRouter::obey(const CommandInfo& info, const Packet& packet) {
  switch (info.chapter) {
    case CommandChapter::Communication:
      return communication_.obey(info.command, packet);
    case CommandChapter::Polling:
      return polling_.obey(info.command, packet);
    case CommandChapter::Status:
      return status_.obey(info.command, packet);
    case CommandChapter::Registers:
      return registers_.obey(info.command, packet);
    case CommandChapter::Motion:
      return motion_.obey(info.command, packet);
    case CommandChapter::Interpolation:
      return interpolation_.obey(info.command, packet);
    case CommandChapter::Protection:
      return protection_.obey(info.command, packet);
    case CommandChapter::Program:
      return program_.obey(info.command);
  }
  return Answer::nak(NakCode::BadCommand);
}

}  // namespace interpolated_motion::emulation
