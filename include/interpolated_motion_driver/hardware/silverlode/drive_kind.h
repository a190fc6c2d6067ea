#pragma once

#include "interpolated_motion_driver/hardware/drive_kind.h"

namespace interpolated_motion::hardware {

/// `silverlode_ims`: QuickSilver SilverLode in interpolated motion, docs/silverlode.md.
const DriveKind& silverlode_kind();

}  // namespace interpolated_motion::hardware
