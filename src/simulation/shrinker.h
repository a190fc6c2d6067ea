#pragma once

#include <functional>

#include "simulation/script.h"

namespace interpolated_motion::simulation {

/// The smallest script found for which `fails` still holds, as it does for `script`: events left out by delta
/// debugging (Zeller, Hildebrandt, "Simplifying and isolating failure-inducing input"), then numbers of
/// events, then keys and joints of the configuration. Calls `fails` at most `tries` times.
Script shrunk(const Script& script, const std::function<bool(const Script&)>& fails, int tries = 300);

}  // namespace interpolated_motion::simulation
