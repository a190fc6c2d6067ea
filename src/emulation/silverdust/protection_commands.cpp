#include "interpolated_motion_driver/emulation/silverdust/protection_commands.h"

#include "interpolated_motion_driver/emulation/silverdust/command_values.h"

namespace interpolated_motion::emulation {

using namespace command_value;

Answer ProtectionCommands::obey(Command command, const Packet& packet) {
  switch (command) {
    case Command::EnableDriver:
    case Command::DisableDriver:
      return enable_driver(command == Command::EnableDriver);
    case Command::Halt:
      return halt();
    case Command::KillMotorConditions:
      return set_kill_conditions(packet);
    case Command::KillEnableDriver:
    case Command::KillDisableDriver:
      return keep_driver(command == Command::KillEnableDriver);
    case Command::ErrorLimits:
      return set_error_limits(packet);
    case Command::TorqueLimits:
      return Answer{};  // the axis of the emulated drive has no torque
    default:
      return Answer::nak(NakCode::BadCommand);
  }
}

Answer ProtectionCommands::enable_driver(bool on) {
  electronics_.enable(on);
  return Answer{};
}

Answer ProtectionCommands::halt() {
  electronics_.halt();
  return Answer{};
}

Answer ProtectionCommands::set_kill_conditions(const Packet& packet) {
  const auto& p = packet.parameters;
  if (!is_word(p[0]) || !is_word(p[1])) return Answer::bad_value();
  electronics_.set_kill_conditions(to_word(p[0]), to_word(p[1]));
  return Answer{};
}

Answer ProtectionCommands::keep_driver(bool keep) {
  electronics_.keep_driver(keep);
  return Answer{};
}

// Negative limits select the drag mode, which this drive does not have.
Answer ProtectionCommands::set_error_limits(const Packet& packet) {
  const auto& p = packet.parameters;
  const bool valid = in_range(p[0], 1, kInt16Max) && in_range(p[1], 1, kInt16Max) && is_word(p[2]);
  if (!valid) return Answer::bad_value();
  limits_.set(static_cast<int>(p[0]), static_cast<int>(p[1]), static_cast<int>(p[2]));
  return Answer{};
}

}  // namespace interpolated_motion::emulation
