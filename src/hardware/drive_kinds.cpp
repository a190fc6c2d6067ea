#include "interpolated_motion_driver/hardware/drive_kinds.h"

#include "interpolated_motion_driver/hardware/cyclic/drive_kind.h"
#include "interpolated_motion_driver/hardware/epos/drive_kind.h"
#include "interpolated_motion_driver/hardware/silverlode/drive_kind.h"

namespace interpolated_motion::hardware {

const DriveKinds& drive_kinds() {
  static const DriveKinds kinds{&epos_kind(), &silverlode_kind(), &cyclic_kind()};
  return kinds;
}

}  // namespace interpolated_motion::hardware
