#pragma once

#include <string>

namespace interpolated_motion::simulation {

/// An invariant that did not hold.
struct Violation {
  std::string invariant;
  double time = 0.0;  ///< s, on the script's clock
  std::string sentence;
};

}  // namespace interpolated_motion::simulation
