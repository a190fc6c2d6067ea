#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/data_registers.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"

namespace interpolated_motion::emulation {

/// The commands about the data registers: RRG, WRI, WRP.
class RegisterCommands {
 public:
  /// Work on what they are given, which must outlive them.
  RegisterCommands(const SilverDustParameters& parameters, DataRegisters& registers)
      : parameters_(parameters), registers_(registers) {}

  /// Obeys one of them; `packet` has as many parameters as it takes.
  Answer obey(Command command, const Packet& packet);

 private:
  Answer read(const Packet& packet) const;
  Answer write(const Packet& packet);

  const SilverDustParameters& parameters_;
  DataRegisters& registers_;
};

}  // namespace interpolated_motion::emulation
