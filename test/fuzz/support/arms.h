#pragma once

#include <string>

namespace interpolated_motion::fuzz {

/// Configurations of small arms: joint1, joint2 ... with a drive of one of `kinds` each, by their first
/// letter: e (EPOS2), c (cyclic), s (SilverDust).
std::string arm_of(const std::string& kinds);

}  // namespace interpolated_motion::fuzz
