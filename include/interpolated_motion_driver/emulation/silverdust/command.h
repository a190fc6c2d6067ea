#pragma once

#include <cstddef>
#include <cstdint>

namespace interpolated_motion::emulation {

/// The commands an emulated SilverDust knows, with their numbers (Command Reference).
enum class Command : std::uint16_t {
  Poll = 0,                     ///< POL
  ClearPoll = 1,                ///< CPL
  Halt = 2,                     ///< HLT
  Stop = 3,                     ///< STP
  Restart = 4,                  ///< RST
  Revision = 5,                 ///< RVN
  ClearProgram = 8,             ///< CLP
  RunProgram = 10,              ///< RUN
  WriteRegister = 11,           ///< WRI
  ReadRegister = 12,            ///< RRG
  VelocityMode = 15,            ///< VMI
  ReadInternalStatus = 20,      ///< RIS
  ReadIo = 21,                  ///< RIO
  WriteQueue = 25,              ///< IMW
  PollRoutine = 27,             ///< POR
  MoveAbsolute = 134,           ///< MAV
  MoveRelative = 135,           ///< MRV
  ZeroTargetAndPosition = 145,  ///< ZTP
  TargetToPosition = 146,       ///< TTP
  TorqueLimits = 149,           ///< TQL
  ErrorLimits = 151,            ///< ERL
  WriteRegisterProgram = 154,   ///< WRP
  Identity = 155,               ///< IDT
  ClearInternalStatus = 163,    ///< CIS
  CheckInternalStatus = 164,    ///< CKS
  KillMotorConditions = 167,    ///< KMC
  AckDelay = 173,               ///< ADL
  KillEnableDriver = 182,       ///< KED
  KillDisableDriver = 183,      ///< KDD
  EnableDriver = 227,           ///< EMD
  DisableDriver = 228,          ///< DMD
  InterpolatedMoveStart = 253,  ///< IMS
  QueueClear = 254,             ///< IMQ
};

/// When a command is obeyed.
enum class CommandClass {
  Immediate,  ///< A: always
  Override,   ///< F: always; takes over what is running
  Program,    ///< D and E: only while neither a program nor a motion runs, else NAK 2
};

/// Chapter of the Command Reference a command belongs to: which part of the drive it is about.
enum class CommandChapter {
  Communication,  ///< identity, ACK delay, revision, restart
  Polling,        ///< the polling status word
  Status,         ///< the internal status word and the I/O word
  Registers,      ///< data registers
  Motion,         ///< ordinary motions and the target position
  Interpolation,  ///< interpolated motion
  Protection,     ///< the motor's driver, kill motor conditions, limits
  Program,        ///< the standalone program
};

/// A row of the table of commands.
struct CommandInfo {
  Command command;                 ///< its number
  CommandChapter chapter;          ///< who obeys it
  CommandClass command_class;      ///< when it is obeyed
  std::size_t minimum_parameters;  ///< numbers behind that of the command, else NAK 5
  std::size_t maximum_parameters;  ///< included
};

/// The row of a command number; null when the drive does not know it.
const CommandInfo* find_command(std::int64_t number);

/// Codes of a NAK, as far as this drive says them.
enum class NakCode : std::uint16_t {
  BadCommand = 1,  ///< a number the drive does not know
  Busy = 2,        ///< a program class command while a program or a motion runs
  BadFormat = 5,   ///< something else than numbers, or a wrong count of them
  BufferFull = 6,  ///< IMW while as many segments wait as the queue can hold
};

}  // namespace interpolated_motion::emulation
