#pragma once

#include "simulation/arm.h"
#include "simulation/random.h"
#include "simulation/script.h"

namespace interpolated_motion::simulation {

/// What of an arm may fail.
struct FaultKinds {
  bool host = false;    ///< it is late, or dies
  bool buses = false;   ///< frames and characters get lost, cables are pulled
  bool drives = false;  ///< errors, power failures, blocked axes, crystals

  bool any() const { return host || buses || drives; }
};

/// Adds a fault at `time`, its end where it has one, and most times what an operator does next: reset,
/// enable.
void add_random_fault(Random& random, const Arm& arm, const FaultKinds& kinds, double time, Script& script);

}  // namespace interpolated_motion::simulation
