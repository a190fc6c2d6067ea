#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/electronics.h"
#include "interpolated_motion_driver/emulation/silverdust/error_limits.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"

namespace interpolated_motion::emulation {

/// The commands about the motor's driver and about what is to happen when something is wrong: EMD, DMD, HLT,
/// KMC, KED, KDD, ERL, TQL.
class ProtectionCommands {
 public:
  /// Work on what they are given, which must outlive them.
  ProtectionCommands(Electronics& electronics, ErrorLimits& limits)
      : electronics_(electronics), limits_(limits) {}

  /// Obeys one of them; `packet` has as many parameters as it takes.
  Answer obey(Command command, const Packet& packet);

 private:
  Answer enable_driver(bool on);
  Answer halt();
  Answer set_kill_conditions(const Packet& packet);
  Answer keep_driver(bool keep);
  Answer set_error_limits(const Packet& packet);

  Electronics& electronics_;
  ErrorLimits& limits_;
};

}  // namespace interpolated_motion::emulation
