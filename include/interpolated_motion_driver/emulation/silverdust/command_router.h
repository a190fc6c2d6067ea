#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/communication_commands.h"
#include "interpolated_motion_driver/emulation/silverdust/interpolation_commands.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_commands.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_commands.h"
#include "interpolated_motion_driver/emulation/silverdust/program_commands.h"
#include "interpolated_motion_driver/emulation/silverdust/protection_commands.h"
#include "interpolated_motion_driver/emulation/silverdust/register_commands.h"
#include "interpolated_motion_driver/emulation/silverdust/status_commands.h"

namespace interpolated_motion::emulation {

/// All commands of the drive, by the chapter each belongs to.
class CommandRouter {
 public:
  /// Takes copies; the parts of the drive that these work on must outlive it.
  CommandRouter(const CommunicationCommands& communication, const PollingCommands& polling,
                const StatusCommands& status, const RegisterCommands& registers, const MotionCommands& motion,
                const InterpolationCommands& interpolation, const ProtectionCommands& protection,
                const ProgramCommands& program);

  /// Obeys the command of `packet`, whose row in the table is `info`; the packet has as many parameters as
  /// the row allows. The answer is of any kind.
  Answer obey(const CommandInfo& info, const Packet& packet);

 private:
  CommunicationCommands communication_;
  PollingCommands polling_;
  StatusCommands status_;
  RegisterCommands registers_;
  MotionCommands motion_;
  InterpolationCommands interpolation_;
  ProtectionCommands protection_;
  ProgramCommands program_;
};

}  // namespace interpolated_motion::emulation
