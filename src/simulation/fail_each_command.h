#pragma once

#include "simulation/options.h"

namespace interpolated_motion::simulation {

/// `simulate --fail-each WHAT`: one line for each way to fail of each kind of arm, and each violation with
/// its script. The exit code: 0 if there is none.
int run_fail_each(const Options& options);

}  // namespace interpolated_motion::simulation
