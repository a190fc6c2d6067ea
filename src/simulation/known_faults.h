#pragma once

#include <string>
#include <vector>

#include "simulation/violation.h"

namespace interpolated_motion::simulation {

/// A fault of the driver that is known and that an issue will cure. A violation that fits is counted apart.
struct KnownFault {
  std::string name;
  std::string invariant;           ///< that it violates
  std::vector<std::string> parts;  ///< of the violation's sentence, all of them
  std::string cured_by;            ///< the issue, or the entry of the field trial
};

/// The list. It may only shrink (test/simulation/known_faults_test.cpp).
const std::vector<KnownFault>& known_faults();

/// The first that fits, or null.
const KnownFault* find_known(const Violation& violation);

}  // namespace interpolated_motion::simulation
