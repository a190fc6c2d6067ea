#include "interpolated_motion_driver/protocol/cia402/objects.h"

#include "object_names.h"

namespace interpolated_motion::cia402 {
namespace {

// Names as in maxon's EDS, which are those of CiA 301 and CiA 402, ascending for the search.
constexpr ObjectName kNames[] = {
    {object::kDeviceType, "Device Type"},
    {object::kErrorRegister, "Error Register"},
    {object::kErrorHistoryCount, "Number of Errors"},
    {object::kErrorHistoryNewest, "Error History (1)"},
    {object::kSyncCobId, "COB-ID SYNC"},
    {object::kCommunicationCyclePeriod, "Communication Cycle Period"},
    {object::kDeviceName, "Manufacturer Device Name"},
    {object::kHardwareVersion, "Manufacturer Hardware Version"},
    {object::kSoftwareVersion, "Manufacturer Software Version"},
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
    {object::kCurrentActual, "Current Actual Value"},
    {object::kSupplyVoltage, "DC Link Circuit Voltage"},
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
    {object::kMaxAcceleration, "Max Acceleration"},
    {object::kFollowingErrorActual, "Following Error Actual Value"},
    {object::kSupportedDriveModes, "Supported Drive Modes"},
};

}  // namespace

const char* object_name(canopen::ObjectAddress address) { return find_name(kNames, address); }

}  // namespace interpolated_motion::cia402
