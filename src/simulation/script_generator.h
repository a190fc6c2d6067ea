#pragma once

#include <cstdint>
#include <string>

#include "simulation/script.h"

namespace interpolated_motion::simulation {

/// The script of a seed. `kind` of the arm as in arm_kinds(); empty: the seed decides. In half of all scripts
/// nothing but orders happens; in the others the host, the buses or the drives fail.
Script random_script(std::uint64_t seed, const std::string& kind = "");

}  // namespace interpolated_motion::simulation
