#pragma once

#include "interpolated_motion_driver/hardware/drive_kind.h"

namespace interpolated_motion::test {

/// `standstill`: a drive on CANopen that stands still.
const hardware::DriveKind& standstill_kind();

}  // namespace interpolated_motion::test
