#pragma once

#include "interpolated_motion_driver/hardware/drive_kind.h"

namespace interpolated_motion::hardware {

/// `cyclic`: CiA 402 drives in cyclic synchronous position mode, docs/cyclic.md.
const DriveKind& cyclic_kind();

}  // namespace interpolated_motion::hardware
