#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"

namespace interpolated_motion::cia402 {

/// Objects of CiA 301 (0x1000 on) and CiA 402 (0x6000 on) that the driver uses, with the types of these
/// documents. Units of position, velocity and acceleration are the drive's own; those of EPOS2 are told in
/// `epos_objects.h`. Which of them a drive has, it tells by the answer to a read: EPOS2 does not have 0x1006.
namespace object {

using Address = canopen::ObjectAddress;

inline constexpr Address kDeviceType{0x1000, 0};          ///< U32, low word kServoDriveProfile
inline constexpr Address kErrorRegister{0x1001, 0};       ///< U8
inline constexpr Address kErrorHistoryCount{0x1003, 0};   ///< U8; writing 0 clears the history
inline constexpr Address kErrorHistoryNewest{0x1003, 1};  ///< U32, newest first, older ones from sub-index 2
inline constexpr Address kSyncCobId{0x1005, 0};           ///< U32, 0x80 by default
inline constexpr Address kCommunicationCyclePeriod{0x1006, 0};  ///< U32, us between two SYNC
inline constexpr Address kDeviceName{0x1008, 0};                ///< VISIBLE_STRING
inline constexpr Address kHardwareVersion{0x1009, 0};           ///< VISIBLE_STRING
inline constexpr Address kSoftwareVersion{0x100A, 0};           ///< VISIBLE_STRING
inline constexpr Address kStoreParameters{0x1010, 1};           ///< U32, write kStoreSignature
inline constexpr Address kRestoreParameters{0x1011, 1};         ///< U32, write kRestoreSignature
inline constexpr Address kTimeStamp{0x1013,
                                    0};  ///< U32, us; high resolution time stamp, sets the drive's clock
inline constexpr Address kConsumerHeartbeat1{0x1016, 1};  ///< U32, node << 16 | ms
inline constexpr Address kConsumerHeartbeat2{0x1016, 2};  ///< U32, node << 16 | ms
inline constexpr Address kProducerHeartbeat{0x1017, 0};   ///< U16, ms; 0, the default, is off
inline constexpr Address kVendorId{0x1018, 1};            ///< U32, as CiA has given it
inline constexpr Address kProductCode{0x1018, 2};         ///< U32
inline constexpr Address kRevisionNumber{0x1018, 3};      ///< U32
inline constexpr Address kSerialNumber{0x1018, 4};        ///< U32
inline constexpr Address kAbortConnectionOption{
    0x6007, 0};  ///< I16; 0 nothing, 1 fault, 2 disable voltage, 3 quick stop
inline constexpr Address kControlword{0x6040, 0};             ///< U16
inline constexpr Address kStatusword{0x6041, 0};              ///< U16
inline constexpr Address kShutdownOption{0x605B, 0};          ///< I16
inline constexpr Address kDisableOperationOption{0x605C, 0};  ///< I16
inline constexpr Address kFaultReactionOption{0x605E, 0};     ///< I16
inline constexpr Address kModeOfOperation{0x6060, 0};         ///< I8
inline constexpr Address kModeDisplay{0x6061, 0};             ///< I8
inline constexpr Address kPositionDemand{0x6062, 0};          ///< I32
inline constexpr Address kPositionActual{0x6064, 0};          ///< I32
inline constexpr Address kMaxFollowingError{0x6065, 0};       ///< U32, position units
inline constexpr Address kPositionWindow{0x6067, 0};          ///< U32, position units; 0xFFFFFFFF is off
inline constexpr Address kPositionWindowTime{0x6068, 0};      ///< U16, ms
inline constexpr Address kVelocityDemand{0x606B, 0};          ///< I32
inline constexpr Address kVelocityActual{0x606C, 0};          ///< I32
inline constexpr Address kTargetPosition{0x607A, 0};          ///< I32
inline constexpr Address kHomeOffset{0x607C, 0};              ///< I32, position units
inline constexpr Address kMinPositionLimit{0x607D, 1};        ///< I32, position units
inline constexpr Address kMaxPositionLimit{0x607D, 2};        ///< I32, position units
inline constexpr Address kMaxProfileVelocity{0x607F, 0};      ///< U32
inline constexpr Address kProfileVelocity{0x6081, 0};         ///< U32
inline constexpr Address kProfileAcceleration{0x6083, 0};     ///< U32
inline constexpr Address kProfileDeceleration{0x6084, 0};     ///< U32
inline constexpr Address kQuickStopDeceleration{0x6085, 0};   ///< U32
inline constexpr Address kPositionNotation{0x6089, 0};        ///< I8, power of ten of the unit
inline constexpr Address kPositionDimension{0x608A, 0};       ///< U8
inline constexpr Address kVelocityNotation{0x608B, 0};        ///< I8, power of ten of the unit
inline constexpr Address kVelocityDimension{0x608C, 0};       ///< U8
inline constexpr Address kAccelerationNotation{0x608D, 0};    ///< I8, power of ten of the unit
inline constexpr Address kAccelerationDimension{0x608E, 0};   ///< U8
inline constexpr Address kInterpolationSubMode{0x60C0, 0};    ///< I16; below 0: of the manufacturer
inline constexpr Address kVelocityOffset{0x60B1, 0};          ///< I32, in the unit of 0x606C
inline constexpr Address kTorqueOffset{0x60B2, 0};            ///< I16, per mille of the rated torque
inline constexpr Address kInterpolationPeriod{0x60C2, 1};  ///< U8, in units of 10^kInterpolationTimeIndex s
inline constexpr Address kInterpolationTimeIndex{0x60C2, 2};  ///< I8, power of ten of 1 s, -3: ms
inline constexpr Address kMaxAcceleration{0x60C5, 0};         ///< U32
inline constexpr Address kCurrentActual{0x6078, 0};           ///< I16, per mille of the rated current
inline constexpr Address kSupplyVoltage{0x6079, 0};           ///< U32, mV, of the DC link
inline constexpr Address kFollowingErrorActual{
    0x60F4, 0};  ///< I32, position units; EPOS2 has kFollowingError instead
inline constexpr Address kSupportedDriveModes{0x6502, 0};  ///< U32, bit n - 1: mode n

}  // namespace object

/// Objects as they are mapped into PDOs: index, sub-index and length in bits (CiA 301, 0x1600 and 0x1A00).
namespace pdo_entry {

inline constexpr canopen::PdoEntry kControlword{object::kControlword, 16};                    ///< 0x60400010
inline constexpr canopen::PdoEntry kStatusword{object::kStatusword, 16};                      ///< 0x60410010
inline constexpr canopen::PdoEntry kModeOfOperation{object::kModeOfOperation, 8};             ///< 0x60600008
inline constexpr canopen::PdoEntry kModeDisplay{object::kModeDisplay, 8};                     ///< 0x60610008
inline constexpr canopen::PdoEntry kPositionDemand{object::kPositionDemand, 32};              ///< 0x60620020
inline constexpr canopen::PdoEntry kPositionActual{object::kPositionActual, 32};              ///< 0x60640020
inline constexpr canopen::PdoEntry kVelocityActual{object::kVelocityActual, 32};              ///< 0x606C0020
inline constexpr canopen::PdoEntry kTargetPosition{object::kTargetPosition, 32};              ///< 0x607A0020
inline constexpr canopen::PdoEntry kVelocityOffset{object::kVelocityOffset, 32};              ///< 0x60B10020
inline constexpr canopen::PdoEntry kTorqueOffset{object::kTorqueOffset, 16};                  ///< 0x60B20010
inline constexpr canopen::PdoEntry kFollowingErrorActual{object::kFollowingErrorActual, 32};  ///< 0x60F40020
inline constexpr canopen::PdoEntry kTimeStamp{object::kTimeStamp, 32};                        ///< 0x10130020

}  // namespace pdo_entry

inline constexpr std::uint16_t kServoDriveProfile = 402;        ///< low word of 0x1000
inline constexpr std::uint32_t kStoreSignature = 0x65766173;    ///< "save", for 0x1010
inline constexpr std::uint32_t kRestoreSignature = 0x64616F6C;  ///< "load", for 0x1011

/// EMCY code of a drive whose target positions, or whose SYNC, have failed to come (CiA 402, error codes:
/// sync controller).
namespace emergency_code {
inline constexpr std::uint16_t kSyncController = 0x8700;  ///< beyond its ride-through
}  // namespace emergency_code

/// What an object is called in CiA 301, CiA 402 and maxon's documents, which agree, e.g. "Position Actual
/// Value"; empty for objects not listed above.
const char* object_name(canopen::ObjectAddress address);

}  // namespace interpolated_motion::cia402
