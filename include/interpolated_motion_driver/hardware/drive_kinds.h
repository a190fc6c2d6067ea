#pragma once

#include <vector>

namespace interpolated_motion::hardware {

class DriveKind;

/// Kinds of drives that a configuration may name. The first one is meant where it names none.
using DriveKinds = std::vector<const DriveKind*>;

/// All kinds that the driver has: the one list of them.
const DriveKinds& drive_kinds();

}  // namespace interpolated_motion::hardware
