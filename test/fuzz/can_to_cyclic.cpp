// Frames to an emulated drive, as any master might send them: CiA 402, cyclic synchronous position.

#include "fuzz/support/can_drive.h"
#include "interpolated_motion_driver/emulation/cyclic/cyclic_drive.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace interpolated_motion;
  fuzz::CanDriveRun<emulation::CyclicDrive, emulation::CyclicParameters>(fuzz::FuzzInput(data, size))();
  return 0;
}
