#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace interpolated_motion::cia402 {

/// Modes of operation, objects 0x6060 and 0x6061: those of CiA 402 and, negative, those of EPOS2.
enum class Mode : std::int8_t {
  StepDirection = -6,
  MasterEncoder = -5,
  Diagnostic = -4,
  Current = -3,
  Velocity = -2,
  Position = -1,
  None = 0,
  ProfilePosition = 1,
  ProfileVelocity = 3,
  ProfileTorque = 4,
  Homing = 6,
  InterpolatedPosition = 7,
  CyclicSynchronousPosition = 8,
  CyclicSynchronousVelocity = 9,
  CyclicSynchronousTorque = 10,
};

/// "interpolated position", ..., "unknown" for a value that is none of the above.
std::string_view to_text(Mode mode);

/// Whether supported drive modes, object 0x6502, name a mode: bit `mode - 1` of CiA 402 (bit 6 is
/// interpolated position). Always false for EPOS2's own modes, which have no bit there.
bool supports(std::uint32_t supported_drive_modes, Mode mode);

/// "profile position, homing, interpolated position (0x00000061)".
std::string supported_modes_text(std::uint32_t supported_drive_modes);

}  // namespace interpolated_motion::cia402
