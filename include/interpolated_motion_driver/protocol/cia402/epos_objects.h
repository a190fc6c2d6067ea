#pragma once

#include <cstdint>
#include <string>

#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"

namespace interpolated_motion::cia402 {

/// Objects of EPOS2 that the driver uses, with the types of maxon's EDS for firmware 0x2126. EPOS2 does not
/// have 0x603F, 0x605A, 0x60C1, 0x1006 and 0x1029; asked for them it aborts with 0x06020000.
namespace object {

using Address = canopen::ObjectAddress;

inline constexpr Address kDeviceType{0x1000, 0};          ///< U32, low word 402
inline constexpr Address kErrorRegister{0x1001, 0};       ///< U8
inline constexpr Address kErrorHistoryCount{0x1003, 0};   ///< U8; writing 0 clears the history
inline constexpr Address kErrorHistoryNewest{0x1003, 1};  ///< U32, sub-index 1..5, newest first
inline constexpr Address kSyncCobId{0x1005, 0};           ///< U32, always 0x80
inline constexpr Address kDeviceName{0x1008, 0};          ///< VISIBLE_STRING
inline constexpr Address kStoreParameters{0x1010, 1};     ///< U32
inline constexpr Address kRestoreParameters{0x1011, 1};   ///< U32
inline constexpr Address kTimeStamp{0x1013,
                                    0};  ///< U32, us; high resolution time stamp, sets the drive's clock
inline constexpr Address kConsumerHeartbeat1{0x1016, 1};   ///< U32, node << 16 | ms
inline constexpr Address kConsumerHeartbeat2{0x1016, 2};   ///< U32
inline constexpr Address kProducerHeartbeat{0x1017, 0};    ///< U16, ms; 0, the default, is off
inline constexpr Address kVendorId{0x1018, 1};             ///< U32
inline constexpr Address kProductCode{0x1018, 2};          ///< U32, hardware version << 16
inline constexpr Address kRevisionNumber{0x1018, 3};       ///< U32, firmware version << 16
inline constexpr Address kSerialNumber{0x1018, 4};         ///< U32
inline constexpr Address kPositionModeSetting{0x2062, 0};  ///< I32, qc; setpoint of mode -1
inline constexpr Address kInterpolationRecord{0x20C1, 0};  ///< 8 bytes, write only
inline constexpr Address kBufferStatus{0x20C4, 1};         ///< U16
inline constexpr Address kUnderflowWarning{0x20C4, 2};     ///< U16, records, 0..63, default 4
inline constexpr Address kOverflowWarning{0x20C4, 3};      ///< U16, records, 1..64, default 60
inline constexpr Address kFollowingError{0x20F4, 0};       ///< I16, qc
inline constexpr Address kAbortConnectionOption{
    0x6007, 0};  ///< I16; 0 nothing, 1 fault, 2 disable voltage, 3 quick stop
inline constexpr Address kControlword{0x6040, 0};             ///< U16
inline constexpr Address kStatusword{0x6041, 0};              ///< U16
inline constexpr Address kShutdownOption{0x605B, 0};          ///< I16
inline constexpr Address kDisableOperationOption{0x605C, 0};  ///< I16
inline constexpr Address kFaultReactionOption{0x605E, 0};     ///< I16
inline constexpr Address kModeOfOperation{0x6060, 0};         ///< I8
inline constexpr Address kModeDisplay{0x6061, 0};             ///< I8
inline constexpr Address kPositionDemand{0x6062, 0};          ///< I32, qc
inline constexpr Address kPositionActual{0x6064, 0};          ///< I32, qc
inline constexpr Address kMaxFollowingError{0x6065, 0};       ///< U32, qc
inline constexpr Address kPositionWindow{0x6067, 0};          ///< U32, qc; 0xFFFFFFFF is off
inline constexpr Address kPositionWindowTime{0x6068, 0};      ///< U16, ms
inline constexpr Address kVelocityDemand{0x606B, 0};          ///< I32, rpm
inline constexpr Address kVelocityActual{0x606C, 0};          ///< I32, rpm
inline constexpr Address kTargetPosition{0x607A, 0};          ///< I32, qc
inline constexpr Address kHomeOffset{0x607C, 0};              ///< I32, qc
inline constexpr Address kMinPositionLimit{0x607D, 1};        ///< I32, qc
inline constexpr Address kMaxPositionLimit{0x607D, 2};        ///< I32, qc
inline constexpr Address kMaxProfileVelocity{0x607F, 0};      ///< U32, rpm; faster in mode 7 is an error
inline constexpr Address kProfileVelocity{0x6081, 0};         ///< U32, rpm; faster in mode 7 is a warning
inline constexpr Address kProfileAcceleration{0x6083, 0};     ///< U32, rpm/s; more in mode 7 is a warning
inline constexpr Address kProfileDeceleration{0x6084, 0};     ///< U32, rpm/s
inline constexpr Address kQuickStopDeceleration{0x6085, 0};   ///< U32, rpm/s
inline constexpr Address kPositionNotation{0x6089, 0};        ///< I8
inline constexpr Address kPositionDimension{0x608A, 0};       ///< U8, 0xAC: qc
inline constexpr Address kVelocityNotation{0x608B, 0};        ///< I8, 0: rpm, -3: milli-rpm
inline constexpr Address kVelocityDimension{0x608C, 0};       ///< U8, 0xA4: rpm
inline constexpr Address kAccelerationNotation{0x608D, 0};    ///< I8
inline constexpr Address kAccelerationDimension{0x608E, 0};   ///< U8
inline constexpr Address kInterpolationSubMode{0x60C0, 0};    ///< I16, -1: cubic spline (PVT)
inline constexpr Address kInterpolationPeriod{0x60C2, 1};     ///< U8, always 1
inline constexpr Address kInterpolationTimeIndex{0x60C2, 2};  ///< I8, always -3
inline constexpr Address kMaximumBufferSize{0x60C4, 1};       ///< U32, records
inline constexpr Address kFreeRecords{0x60C4, 2};             ///< U32, "actual buffer size"
inline constexpr Address kBufferOrganisation{0x60C4, 3};      ///< U8, 0: FIFO
inline constexpr Address kUsedRecords{0x60C4, 4};             ///< U16, "buffer position"
inline constexpr Address kRecordSize{0x60C4, 5};              ///< U8, write only, 8
inline constexpr Address kBufferClear{0x60C4, 6};          ///< U8, write only; 0 clears and closes, 1 opens
inline constexpr Address kMaxAcceleration{0x60C5, 0};      ///< U32, rpm/s; more in mode 7 is an error
inline constexpr Address kSupportedDriveModes{0x6502, 0};  ///< U32

}  // namespace object

/// Objects as they are mapped into PDOs.
namespace pdo_entry {

inline constexpr canopen::PdoEntry kInterpolationRecord{object::kInterpolationRecord, 64};  ///< 0x20C10040
inline constexpr canopen::PdoEntry kBufferStatus{object::kBufferStatus, 16};                ///< 0x20C40110
inline constexpr canopen::PdoEntry kFreeRecords{object::kFreeRecords, 32};                  ///< 0x60C40220
inline constexpr canopen::PdoEntry kControlword{object::kControlword, 16};                  ///< 0x60400010
inline constexpr canopen::PdoEntry kStatusword{object::kStatusword, 16};                    ///< 0x60410010
inline constexpr canopen::PdoEntry kModeOfOperation{object::kModeOfOperation, 8};           ///< 0x60600008
inline constexpr canopen::PdoEntry kModeDisplay{object::kModeDisplay, 8};                   ///< 0x60610008
inline constexpr canopen::PdoEntry kPositionDemand{object::kPositionDemand, 32};            ///< 0x60620020
inline constexpr canopen::PdoEntry kPositionActual{object::kPositionActual, 32};            ///< 0x60640020
inline constexpr canopen::PdoEntry kVelocityActual{object::kVelocityActual, 32};            ///< 0x606C0020
inline constexpr canopen::PdoEntry kFollowingError{object::kFollowingError, 16};            ///< 0x20F40010
inline constexpr canopen::PdoEntry kTimeStamp{object::kTimeStamp, 32};                      ///< 0x10130020

}  // namespace pdo_entry

/// Values the driver compares with.
inline constexpr std::uint32_t kMaxonVendorId = 0x000000FB;
inline constexpr std::uint16_t kServoDriveProfile = 402;        ///< low word of 0x1000
inline constexpr std::uint8_t kPositionDimensionQc = 0xAC;      ///< 0x608A
inline constexpr std::uint8_t kVelocityDimensionRpm = 0xA4;     ///< 0x608C
inline constexpr std::int16_t kCubicSplineSubMode = -1;         ///< 0x60C0
inline constexpr std::uint32_t kFifoRecords = 64;               ///< 0x60C4:01
inline constexpr std::uint8_t kRecordBytes = 8;                 ///< 0x60C4:05
inline constexpr std::uint8_t kBufferClearAndClose = 0;         ///< 0x60C4:06
inline constexpr std::uint8_t kBufferOpen = 1;                  ///< 0x60C4:06
inline constexpr std::uint32_t kStoreSignature = 0x65766173;    ///< "save", for 0x1010
inline constexpr std::uint32_t kRestoreSignature = 0x64616F6C;  ///< "load", for 0x1011

/// Who a drive says it is, object 0x1018.
struct Identity {
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;   ///< hardware version << 16
  std::uint32_t revision = 0;  ///< firmware version << 16
  std::uint32_t serial = 0;

  bool is_maxon() const { return vendor == kMaxonVendorId; }
  std::uint16_t hardware_version() const { return static_cast<std::uint16_t>(product >> 16); }
  std::uint16_t firmware_version() const { return static_cast<std::uint16_t>(revision >> 16); }
};

/// "maxon EPOS2 70/10, firmware 0x2126", "maxon drive, hardware 0x6322, firmware 0x2100" for hardware
/// versions not known by name, "vendor 0x0000009A, product 0x00000030" for others. For texts only: whether a
/// drive has mode 7 is told by its objects (0x60C4 and 0x20C1; EPOS4 up to firmware 0x0170 has neither), not
/// by its product code.
std::string describe_identity(const Identity& identity);

/// What an object is called in maxon's documents, e.g. "Interpolation Buffer Status"; empty for objects not
/// listed above.
const char* object_name(canopen::ObjectAddress address);

}  // namespace interpolated_motion::cia402
