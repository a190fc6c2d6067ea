#include "interpolated_motion_driver/emulation/silverdust/program.h"

#include "interpolated_motion_driver/emulation/silverdust/registers.h"

namespace interpolated_motion::emulation {

void StoredProgram::tick(ProgramTarget& target) {
  if (execute(steps_[next_], target)) ++next_;
  if (next_ == steps_.size()) running_ = false;
}

bool StoredProgram::execute(const ProgramStep& step, ProgramTarget& target) const {
  switch (step.kind) {
    case ProgramStep::Kind::WriteRegister:
      target.program_write(step.target, step.value);
      return true;
    case ProgramStep::Kind::CopyRegisters:
      for (std::int64_t i = 0; i < step.count; ++i) {
        target.program_write(step.target + i, target.program_read(step.value + i));
      }
      return true;
    case ProgramStep::Kind::StartInterpolation:
      target.program_start_interpolation();
      return true;
    case ProgramStep::Kind::WaitSegmentTaken:
      break;
  }
  const auto control = static_cast<std::uint32_t>(target.program_read(silverdust_register::kSegmentControl));
  return control >> 16 != 0;
}

}  // namespace interpolated_motion::emulation
