#pragma once

namespace interpolated_motion::emulation {

/// How far from nominal the crystal of an emulated drive may be, ppm, either way: in a configuration and in a
/// command.
constexpr double kLargestClockError = 1e5;

/// Longest time for which a command may switch off a drive or a bus, s.
constexpr double kLongestOff = 3600.0;

}  // namespace interpolated_motion::emulation
