#pragma once

#include "interpolated_motion_driver/hardware/drive_kind.h"

namespace interpolated_motion::hardware {

/// `epos_ipm`: maxon EPOS2 in interpolated position mode, docs/epos.md.
const DriveKind& epos_kind();

}  // namespace interpolated_motion::hardware
