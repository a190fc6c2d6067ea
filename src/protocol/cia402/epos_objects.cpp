#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"

#include "interpolated_motion_driver/protocol/cia402/objects.h"
#include "object_names.h"

namespace interpolated_motion::cia402 {
namespace {

// Names as in maxon's EDS and in "EPOS3 Interpolated Position Mode", ascending for the search.
constexpr ObjectName kNames[] = {
    {object::kPositionModeSetting, "Position Mode Setting Value"},
    {object::kInterpolationRecord, "Interpolation Data Record"},
    {object::kBufferStatus, "Interpolation Buffer Status"},
    {object::kUnderflowWarning, "Interpolation Buffer Underflow Warning"},
    {object::kOverflowWarning, "Interpolation Buffer Overflow Warning"},
    {object::kFollowingError, "Following Error Actual Value"},
    {object::kMaximumBufferSize, "Maximum Buffer Size"},
    {object::kFreeRecords, "Actual Buffer Size"},
    {object::kBufferOrganisation, "Buffer Organization"},
    {object::kUsedRecords, "Buffer Position"},
    {object::kRecordSize, "Size of Data Record"},
    {object::kBufferClear, "Buffer Clear"},
};

}  // namespace

const char* epos_object_name(canopen::ObjectAddress address) {
  const char* name = find_name(kNames, address);
  return *name != '\0' ? name : object_name(address);
}

}  // namespace interpolated_motion::cia402
