#include "interpolated_motion_driver/protocol/cia402/modes.h"

#include <fmt/format.h>

namespace interpolated_motion::cia402 {

std::string_view to_text(Mode mode) {
  switch (mode) {
    case Mode::StepDirection:
      return "step/direction";
    case Mode::MasterEncoder:
      return "master encoder";
    case Mode::Diagnostic:
      return "diagnostic";
    case Mode::Current:
      return "current";
    case Mode::Velocity:
      return "velocity";
    case Mode::Position:
      return "position";
    case Mode::None:
      return "no mode";
    case Mode::ProfilePosition:
      return "profile position";
    case Mode::ProfileVelocity:
      return "profile velocity";
    case Mode::ProfileTorque:
      return "profile torque";
    case Mode::Homing:
      return "homing";
    case Mode::InterpolatedPosition:
      return "interpolated position";
    case Mode::CyclicSynchronousPosition:
      return "cyclic synchronous position";
    case Mode::CyclicSynchronousVelocity:
      return "cyclic synchronous velocity";
    case Mode::CyclicSynchronousTorque:
      return "cyclic synchronous torque";
  }
  return "unknown";
}

bool supports(std::uint32_t supported_drive_modes, Mode mode) {
  const int number = static_cast<int>(mode);
  return number >= 1 && number <= 32 && (supported_drive_modes >> (number - 1) & 1u) != 0;
}

std::string supported_modes_text(std::uint32_t supported_drive_modes) {
  std::string text;
  for (int number = 1; number <= 10; ++number) {
    const auto mode = static_cast<Mode>(number);
    if (!supports(supported_drive_modes, mode)) continue;
    if (!text.empty()) text += ", ";
    text += to_text(mode);
  }
  return fmt::format("{} (0x{:08X})", text.empty() ? "none known" : text, supported_drive_modes);
}

}  // namespace interpolated_motion::cia402
