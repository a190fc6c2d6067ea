#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/serial_interface.h"

namespace interpolated_motion::emulation {

/// The commands about the drive as a unit on its serial line: IDT, ADL, RVN, RST.
class CommunicationCommands {
 public:
  /// Work on what they are given, which must outlive them.
  CommunicationCommands(const SilverDustParameters& parameters, SerialInterface& serial)
      : parameters_(parameters), serial_(serial) {}

  /// Obeys one of them; `packet` has as many parameters as it takes.
  Answer obey(Command command, const Packet& packet);

 private:
  Answer set_identity(const Packet& packet);
  Answer set_ack_delay(const Packet& packet);

  const SilverDustParameters& parameters_;
  SerialInterface& serial_;
};

}  // namespace interpolated_motion::emulation
