#pragma once

#include "interpolated_motion_driver/emulation/silverdust/answer.h"
#include "interpolated_motion_driver/emulation/silverdust/command.h"
#include "interpolated_motion_driver/emulation/silverdust/motion_control.h"
#include "interpolated_motion_driver/emulation/silverdust/program.h"

namespace interpolated_motion::emulation {

/// The commands about the standalone program: CLP, RUN.
class ProgramCommands {
 public:
  /// Work on what they are given, which must outlive them.
  ProgramCommands(StoredProgram& program, const MotionControl& motion) : program_(program), motion_(motion) {}

  /// Obeys one of them.
  Answer obey(Command command);

 private:
  Answer clear();
  Answer run();

  StoredProgram& program_;
  const MotionControl& motion_;
};

}  // namespace interpolated_motion::emulation
