#pragma once

#include <string>

namespace interpolated_motion::simulation {

/// `simulate --recording FILE`: carries the recording out again, tells what happens, and compares the first
/// fault with the recorded one. The exit code: 0 if it is the same. Throws std::runtime_error or
/// std::invalid_argument where the file cannot be read or is no recording.
int replay_recording(const std::string& file);

}  // namespace interpolated_motion::simulation
