#pragma once

#include <string>
#include <vector>

namespace interpolated_motion {

/// The name that is spelled most like `given`, for "did you mean"; empty when every name differs by a third
/// of its letters or more. A letter too many, missing or wrong counts as one, and so do two exchanged
/// neighbours.
std::string closest_name(const std::string& given, const std::vector<std::string>& names);

}  // namespace interpolated_motion
