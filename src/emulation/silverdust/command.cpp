#include "interpolated_motion_driver/emulation/silverdust/command.h"

#include <algorithm>
#include <iterator>

namespace interpolated_motion::emulation {
namespace {

using Chapter = CommandChapter;

constexpr auto kA = CommandClass::Immediate;
constexpr auto kF = CommandClass::Override;
constexpr auto kD = CommandClass::Program;

// In ascending order of the numbers.
constexpr CommandInfo kCommands[] = {
    {Command::Poll, Chapter::Polling, kA, 0, 0},
    {Command::ClearPoll, Chapter::Polling, kA, 1, 1},
    {Command::Halt, Chapter::Protection, kA, 0, 0},
    {Command::Stop, Chapter::Motion, kF, 1, 1},
    {Command::Restart, Chapter::Communication, kA, 0, 0},
    {Command::Revision, Chapter::Communication, kA, 0, 0},
    {Command::ClearProgram, Chapter::Program, kA, 0, 0},
    {Command::RunProgram, Chapter::Program, kA, 0, 0},
    {Command::WriteRegister, Chapter::Registers, kA, 2, 2},
    {Command::ReadRegister, Chapter::Registers, kA, 1, 4},
    {Command::VelocityMode, Chapter::Motion, kF, 4, 4},
    {Command::ReadInternalStatus, Chapter::Status, kA, 0, 0},
    {Command::ReadIo, Chapter::Status, kA, 0, 0},
    {Command::WriteQueue, Chapter::Interpolation, kA, 4, 4},
    {Command::PollRoutine, Chapter::Polling, kA, 0, 0},
    {Command::MoveAbsolute, Chapter::Motion, kD, 5, 5},
    {Command::MoveRelative, Chapter::Motion, kD, 5, 5},
    {Command::ZeroTargetAndPosition, Chapter::Motion, kD, 0, 0},
    {Command::TargetToPosition, Chapter::Motion, kD, 0, 0},
    {Command::TorqueLimits, Chapter::Protection, kD, 4, 4},
    {Command::ErrorLimits, Chapter::Protection, kD, 3, 3},
    {Command::WriteRegisterProgram, Chapter::Registers, kD, 2, 2},
    {Command::Identity, Chapter::Communication, kD, 1, 2},
    {Command::ClearInternalStatus, Chapter::Status, kD, 0, 0},
    {Command::CheckInternalStatus, Chapter::Status, kD, 2, 2},
    {Command::KillMotorConditions, Chapter::Protection, kD, 2, 2},
    {Command::AckDelay, Chapter::Communication, kD, 1, 1},
    {Command::KillEnableDriver, Chapter::Protection, kD, 0, 0},
    {Command::KillDisableDriver, Chapter::Protection, kD, 0, 0},
    {Command::EnableDriver, Chapter::Protection, kD, 0, 0},
    {Command::DisableDriver, Chapter::Protection, kD, 0, 0},
    {Command::InterpolatedMoveStart, Chapter::Interpolation, kD, 0, 2},
    {Command::QueueClear, Chapter::Interpolation, kD, 0, 0},
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
