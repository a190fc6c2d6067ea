#include "interpolated_motion_driver/emulation/silverdust/command.h"

#include <algorithm>
#include <iterator>

namespace interpolated_motion::emulation {
namespace {

constexpr auto kA = CommandClass::Immediate;
constexpr auto kF = CommandClass::Override;
constexpr auto kD = CommandClass::Program;

// In ascending order of the numbers.
constexpr CommandInfo kCommands[] = {
    {Command::Poll, kA, 0, 0},
    {Command::ClearPoll, kA, 1, 1},
    {Command::Halt, kA, 0, 0},
    {Command::Stop, kF, 1, 1},
    {Command::Restart, kA, 0, 0},
    {Command::Revision, kA, 0, 0},
    {Command::ClearProgram, kA, 0, 0},
    {Command::RunProgram, kA, 0, 0},
    {Command::WriteRegister, kA, 2, 2},
    {Command::ReadRegister, kA, 1, 4},
    {Command::VelocityMode, kF, 4, 4},
    {Command::ReadInternalStatus, kA, 0, 0},
    {Command::ReadIo, kA, 0, 0},
    {Command::WriteQueue, kA, 4, 4},
    {Command::PollRoutine, kA, 0, 0},
    {Command::MoveAbsolute, kD, 5, 5},
    {Command::MoveRelative, kD, 5, 5},
    {Command::ZeroTargetAndPosition, kD, 0, 0},
    {Command::TargetToPosition, kD, 0, 0},
    {Command::TorqueLimits, kD, 4, 4},
    {Command::ErrorLimits, kD, 3, 3},
    {Command::WriteRegisterProgram, kD, 2, 2},
    {Command::Identity, kD, 1, 2},
    {Command::ClearInternalStatus, kD, 0, 0},
    {Command::CheckInternalStatus, kD, 2, 2},
    {Command::KillMotorConditions, kD, 2, 2},
    {Command::AckDelay, kD, 1, 1},
    {Command::KillEnableDriver, kD, 0, 0},
    {Command::KillDisableDriver, kD, 0, 0},
    {Command::EnableDriver, kD, 0, 0},
    {Command::DisableDriver, kD, 0, 0},
    {Command::InterpolatedMoveStart, kD, 0, 2},
    {Command::QueueClear, kD, 0, 0},
};

}  // namespace

const CommandInfo* find_command(std::int64_t number) {
  const auto* found = std::lower_bound(
      std::begin(kCommands), std::end(kCommands), number,
      [](const CommandInfo& info, std::int64_t n) { return static_cast<std::int64_t>(info.command) < n; });
  const bool known = found != std::end(kCommands) && static_cast<std::int64_t>(found->command) == number;
  return known ? found : nullptr;
}

}  // namespace interpolated_motion::emulation
