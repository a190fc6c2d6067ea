#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/axis.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/electronics.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/packet.h"
#include "interpolated_motion_driver/emulation/silverdust/program.h"

namespace interpolated_motion::emulation {

/// The commands about ordinary motions and the target position: MAV, MRV, VMI, STP, ZTP, TTP.
class MotionCommands {
 public:
  /// Work on what they are given, which must outlive them.
  MotionCommands(MotionControl& motion, LaggingAxis& axis, StoredProgram& program,
                 const Electronics& electronics)
      : motion_(motion), axis_(axis), program_(program), electronics_(electronics) {}

  /// Obeys one of them; `packet` has as many parameters as it takes.
  Answer obey(Command command, const Packet& packet);

 private:
  Answer move(const Packet& packet, std::int64_t origin);
  Answer velocity_mode(const Packet& packet);
  Answer stop(const Packet& packet);
  Answer zero_target_and_position();
  Answer target_to_position();

  MotionControl& motion_;
  LaggingAxis& axis_;
  StoredProgram& program_;
  const Electronics& electronics_;
};

}  // namespace interpolated_motion::emulation
