#pragma once

#include <string>
#include <vector>

#include "simulation/random.h"

namespace interpolated_motion::simulation {

/// Kinds of arms: epos, silverlode, cyclic, mixed (EPOS and SilverLode), all (drives of all kinds), random.
const std::vector<std::string>& arm_kinds();

/// The driver's parameters for a random arm of `kind`, one line of YAML that the driver takes: rates, depths,
/// horizons, crystals, phases, and what vendors leave open either way. The settings match the emulated
/// drives: the arm works.
std::string random_arm(Random& random, const std::string& kind);

}  // namespace interpolated_motion::simulation
