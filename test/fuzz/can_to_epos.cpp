// Frames to an emulated drive, as any master might send them: EPOS2.

#include "fuzz/support/can_drive.h"
#include "interpolated_motion_driver/emulation/epos/epos_drive.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace interpolated_motion;
  fuzz::CanDriveRun<emulation::EposDrive, emulation::EposParameters>(fuzz::FuzzInput(data, size))();
  return 0;
}
