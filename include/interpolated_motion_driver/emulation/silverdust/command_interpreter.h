#pragma once

#include <cstdint>

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/command_router.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_status.h"
#include "interpolated_motion_driver/emulation/silverdust/program.h"

namespace interpolated_motion::emulation {

/// Commands that are refused without being looked at.
struct CommandRefusals {
  std::int64_t command = -1;           ///< their number
  NakCode code = NakCode::BadCommand;  ///< what is said to them
  int left = 0;                        ///< how many
};

/// What a packet makes the drive do, and the answer to it: format and class of the command first ("SilverLode
/// User Manual", command classes), then what its chapter says, then what becomes of the polling status word.
class CommandInterpreter {
 public:
  /// All but `commands` must outlive it.
  CommandInterpreter(const SilverDustParameters& parameters, PollingStatus& polling,
                     const MotionControl& motion, const StoredProgram& program,
                     const CommandRouter& commands);

  /// Executes a packet for this drive. The answer is an Acknowledge, Data, a Nak or a Restart, which is left
  /// to the caller.
  Answer execute(const Packet& packet);

  /// Refuses commands from now on.
  void refuse_next(const CommandRefusals& refusals) { refusals_ = refusals; }

  /// Packets executed so far.
  std::uint64_t executed() const { return executed_; }

 private:
  bool refuses(const Packet& packet);
  bool busy() const { return motion_.active() || program_.running(); }
  Answer obey_program_class(const CommandInfo& info, const Packet& packet);
  Answer obey_immediate(const CommandInfo& info, const Packet& packet);
  Answer settled(const Answer& answer);

  const SilverDustParameters& parameters_;
  PollingStatus& polling_;
  const MotionControl& motion_;
  const StoredProgram& program_;
  CommandRouter commands_;
  CommandRefusals refusals_;
  std::uint64_t executed_ = 0;
};

}  // namespace interpolated_motion::emulation
