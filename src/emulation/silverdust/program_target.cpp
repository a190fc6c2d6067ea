#include "interpolated_motion_driver/emulation/silverdust/program_target.h"

namespace interpolated_motion::emulation {

void ProgramTarget::write(std::int64_t reg, std::int32_t value) {
  const bool written = RegisterFile::writable(reg) && registers_.write(reg, value);
  if (!written) polling_.raise(polling_bit::kCommandError);
}

std::int32_t ProgramTarget::read(std::int64_t reg) const {
  return RegisterFile::exists(reg) ? registers_.read(reg) : 0;
}

void ProgramTarget::start_interpolation() {
  if (motion_.active() || !electronics_.enabled()) return polling_.raise(polling_bit::kCommandError);
  motion_.interpolate();
}

}  // namespace interpolated_motion::emulation
