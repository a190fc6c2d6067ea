#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/electronics.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/polling_status.h"

namespace interpolated_motion::emulation {

/// The commands about the internal status word and the I/O word: RIS, RIO, CIS, CKS.
class StatusCommands {
 public:
  /// Work on what they are given, which must outlive them.
  StatusCommands(PollingStatus& polling, Electronics& electronics, const MotionControl& motion)
      : polling_(polling), electronics_(electronics), motion_(motion) {}

  /// Obeys one of them; `packet` has as many parameters as it takes.
  Answer obey(Command command, const Packet& packet);

 private:
  Answer clear();
  Answer check(const Packet& packet);

  PollingStatus& polling_;
  Electronics& electronics_;
  const MotionControl& motion_;
};

}  // namespace interpolated_motion::emulation
