#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/parameters.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_status.h"

namespace interpolated_motion::emulation {

/// The commands about the polling status word: POL, POR, CPL ("Polling", QCI-TD045).
class PollingCommands {
 public:
  /// Work on what they are given, which must outlive them.
  PollingCommands(const SilverDustParameters& parameters, PollingStatus& status)
      : parameters_(parameters), status_(status) {}

  /// Obeys one of them; `packet` has as many parameters as it takes.
  Answer obey(Command command, const Packet& packet);

 private:
  Answer poll();
  Answer poll_in_full();
  Answer clear(const Packet& packet);

  const SilverDustParameters& parameters_;
  PollingStatus& status_;
};

}  // namespace interpolated_motion::emulation
