#pragma once

#include <string>

#include "hardware/scenario.h"

namespace interpolated_motion::test {

/// An arm of six joints with drives of one kind, or of all.
struct KindOfArm {
  const char* name;
  YAML::Node (*arm)(const std::string& changes);
};

inline constexpr KindOfArm kKindsOfArms[] = {{"epos", six_axis},
                                             {"silverlode", six_axis_silverlode},
                                             {"cyclic", six_axis_cyclic},
                                             {"all_kinds", six_axis_of_all_kinds}};

}  // namespace interpolated_motion::test
