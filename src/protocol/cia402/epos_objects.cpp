#include "interpolated_motion_driver/protocol/cia402/epos_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace interpolated_motion::cia402 {
namespace {

struct ObjectName {
  canopen::ObjectAddress address;
  const char* name;
};

// Names as in maxon's EDS and in "EPOS3 Interpolated Position Mode", ascending for the search.
constexpr ObjectName kNames[] = {
    {object::kDeviceType, "Device Type"},
    {object::kErrorRegister, "Error Register"},
    {object::kErrorHistoryCount, "Number of Errors"},
    {object::kErrorHistoryNewest, "Error History (1)"},
    {object::kSyncCobId, "COB-ID SYNC"},
    {object::kDeviceName, "Manufacturer Device Name"},
    {object::kStoreParameters, "Save All Parameters"},
    {object::kRestoreParameters, "Restore All Default Parameters"},
    {object::kTimeStamp, "High Resolution Time Stamp"},
    {object::kConsumerHeartbeat1, "Consumer 1 Heartbeat Time"},
    {object::kConsumerHeartbeat2, "Consumer 2 Heartbeat Time"},
    {object::kProducerHeartbeat, "Producer Heartbeat Time"},
    {object::kVendorId, "Vendor ID"},
    {object::kProductCode, "Product Code"},
    {object::kRevisionNumber, "Revision Number"},
    {object::kSerialNumber, "Serial Number"},
    {object::kPositionModeSetting, "Position Mode Setting Value"},
    {object::kInterpolationRecord, "Interpolation Data Record"},
    {object::kBufferStatus, "Interpolation Buffer Status"},
    {object::kUnderflowWarning, "Interpolation Buffer Underflow Warning"},
    {object::kOverflowWarning, "Interpolation Buffer Overflow Warning"},
    {object::kFollowingError, "Following Error Actual Value"},
    {object::kAbortConnectionOption, "Abort Connection Option Code"},
    {object::kControlword, "Controlword"},
    {object::kStatusword, "Statusword"},
    {object::kShutdownOption, "Shutdown Option Code"},
    {object::kDisableOperationOption, "Disable Operation Option Code"},
    {object::kFaultReactionOption, "Fault Reaction Option Code"},
    {object::kModeOfOperation, "Modes of Operation"},
    {object::kModeDisplay, "Modes of Operation Display"},
    {object::kPositionDemand, "Position Demand Value"},
    {object::kPositionActual, "Position Actual Value"},
    {object::kMaxFollowingError, "Max Following Error"},
    {object::kPositionWindow, "Position Window"},
    {object::kPositionWindowTime, "Position Window Time"},
    {object::kVelocityDemand, "Velocity Demand Value"},
    {object::kVelocityActual, "Velocity Actual Value"},
    {object::kTargetPosition, "Target Position"},
    {object::kHomeOffset, "Home Offset"},
    {object::kMinPositionLimit, "Min Position Limit"},
    {object::kMaxPositionLimit, "Max Position Limit"},
    {object::kMaxProfileVelocity, "Max Profile Velocity"},
    {object::kProfileVelocity, "Profile Velocity"},
    {object::kProfileAcceleration, "Profile Acceleration"},
    {object::kProfileDeceleration, "Profile Deceleration"},
    {object::kQuickStopDeceleration, "QuickStop Deceleration"},
    {object::kPositionNotation, "Position Notation Index"},
    {object::kPositionDimension, "Position Dimension Index"},
    {object::kVelocityNotation, "Velocity Notation Index"},
    {object::kVelocityDimension, "Velocity Dimension Index"},
    {object::kAccelerationNotation, "Acceleration Notation Index"},
    {object::kAccelerationDimension, "Acceleration Dimension Index"},
    {object::kInterpolationSubMode, "Interpolation Sub Mode Selection"},
    {object::kInterpolationPeriod, "Interpolation Time Period Value"},
    {object::kInterpolationTimeIndex, "Interpolation Time Index"},
    {object::kMaximumBufferSize, "Maximum Buffer Size"},
    {object::kFreeRecords, "Actual Buffer Size"},
    {object::kBufferOrganisation, "Buffer Organization"},
    {object::kUsedRecords, "Buffer Position"},
    {object::kRecordSize, "Size of Data Record"},
    {object::kBufferClear, "Buffer Clear"},
    {object::kMaxAcceleration, "Max Acceleration"},
    {object::kSupportedDriveModes, "Supported Drive Modes"},
};

}  // namespace

const char* object_name(canopen::ObjectAddress address) {
  const auto* found =
      std::lower_bound(std::begin(kNames), std::end(kNames), address,
                       [](const ObjectName& entry, canopen::ObjectAddress a) { return entry.address < a; });
  return found != std::end(kNames) && found->address == address ? found->name : "";
}

std::string describe_identity(const Identity& identity) {
  // Product number of maxon's EDS for the EPOS2 70/10, firmware 0x2126.
  constexpr std::uint16_t kEpos2Hardware = 0x6420;
  if (!identity.is_maxon()) {
    return fmt::format("vendor 0x{:08X}, product 0x{:08X}", identity.vendor, identity.product);
  }
  const std::string firmware = fmt::format("firmware 0x{:04X}", identity.firmware_version());
  if (identity.hardware_version() == kEpos2Hardware) return "maxon EPOS2 70/10, " + firmware;
  return fmt::format("maxon drive, hardware 0x{:04X}, {}", identity.hardware_version(), firmware);
}

}  // namespace interpolated_motion::cia402
