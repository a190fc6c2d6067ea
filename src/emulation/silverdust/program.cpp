#include "interpolated_motion_driver/emulation/silverdust/program.h"

#include "interpolated_motion_driver/emulation/silverdust/program_target.h"
#include "interpolated_motion_driver/emulation/silverdust/registers.h"

namespace interpolated_motion::emulation {

void StoredProgram::tick(ProgramTarget& target) {
  if (execute(steps_[next_], target)) ++next_;
  if (next_ == steps_.size()) running_ = false;
}

bool StoredProgram::execute(const ProgramStep& step, ProgramTarget& target) const {
  switch (step.kind) {
    case ProgramStep::Kind::WriteRegister:
      target.write(step.target, step.value);
      return true;
    case ProgramStep::Kind::CopyRegisters:
      for (std::int64_t i = 0; i < step.count; ++i) {
        target.write(step.target + i, target.read(step.value + i));
      }
      return true;
    case ProgramStep::Kind::StartInterpolation:
      target.start_interpolation();
      return true;
    case ProgramStep::Kind::WaitSegmentTaken:
      break;
  }
  const auto control = static_cast<std::uint32_t>(target.read(silverdust_register::kSegmentControl));
  return control >> 16 != 0;
}

}  // namespace interpolated_motion::emulation
