#pragma once

/// Bits of EntryHead::flags.
namespace interpolated_motion::recording {

// Of a frame or a line.
inline constexpr int kOwn = 1;  ///< the host has sent it
inline constexpr int kExtended = 2;
inline constexpr int kRemote = 4;
// Of a setpoint.
inline constexpr int kHasVelocities = 1;
inline constexpr int kIsRefused = 2;

}  // namespace interpolated_motion::recording
