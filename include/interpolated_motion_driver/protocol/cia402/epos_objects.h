#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"

namespace interpolated_motion::cia402 {

/// Objects of maxon's own, and those of the interpolation buffer, in which EPOS2 goes beyond CiA 402; with
/// the types of maxon's EDS for firmware 0x2126. The others: `objects.h`. There EPOS2 counts positions in qc
/// (quadrature counts), velocities in rpm and accelerations in rpm/s, 0x60C2 always says 1 ms, and in mode 7
/// more than 0x607F or 0x60C5 is an error, more than 0x6081 or 0x6083 a warning. EPOS2 does not have 0x603F,
/// 0x605A, 0x60C1, 0x1006 and 0x1029; asked for them it aborts with 0x06020000.
namespace object {

inline constexpr canopen::ObjectAddress kPositionModeSetting{0x2062, 0};  ///< I32, qc; setpoint of mode -1
inline constexpr canopen::ObjectAddress kInterpolationRecord{0x20C1, 0};  ///< 8 bytes, write only
inline constexpr canopen::ObjectAddress kBufferStatus{0x20C4, 1};         ///< U16, see BufferStatus
inline constexpr canopen::ObjectAddress kUnderflowWarning{0x20C4, 2};     ///< U16, records, 0..63, default 4
inline constexpr canopen::ObjectAddress kOverflowWarning{0x20C4, 3};      ///< U16, records, 1..64, default 60
inline constexpr canopen::ObjectAddress kFollowingError{0x20F4, 0};       ///< I16, qc
inline constexpr canopen::ObjectAddress kMaximumBufferSize{0x60C4, 1};    ///< U32, records
inline constexpr canopen::ObjectAddress kFreeRecords{0x60C4, 2};          ///< U32, "actual buffer size"
inline constexpr canopen::ObjectAddress kBufferOrganisation{0x60C4, 3};   ///< U8, 0: FIFO
inline constexpr canopen::ObjectAddress kUsedRecords{0x60C4, 4};          ///< U16, "buffer position"
inline constexpr canopen::ObjectAddress kRecordSize{0x60C4, 5};           ///< U8, write only, kRecordBytes
inline constexpr canopen::ObjectAddress kBufferClear{0x60C4,
                                                     6};  ///< U8, write only; 0 clears and closes, 1 opens

}  // namespace object

/// Objects as they are mapped into PDOs.
namespace pdo_entry {

inline constexpr canopen::PdoEntry kInterpolationRecord{object::kInterpolationRecord, 64};  ///< 0x20C10040
inline constexpr canopen::PdoEntry kBufferStatus{object::kBufferStatus, 16};                ///< 0x20C40110
inline constexpr canopen::PdoEntry kFreeRecords{object::kFreeRecords, 32};                  ///< 0x60C40220
inline constexpr canopen::PdoEntry kFollowingError{object::kFollowingError, 16};            ///< 0x20F40010

}  // namespace pdo_entry

inline constexpr std::uint8_t kPositionDimensionQc = 0xAC;   ///< 0x608A
inline constexpr std::uint8_t kVelocityDimensionRpm = 0xA4;  ///< 0x608C
inline constexpr std::int16_t kCubicSplineSubMode = -1;      ///< 0x60C0
inline constexpr std::uint32_t kFifoRecords = 64;            ///< 0x60C4:01
inline constexpr std::uint8_t kRecordBytes = 8;              ///< 0x60C4:05
inline constexpr std::uint8_t kBufferClearAndClose = 0;      ///< 0x60C4:06
inline constexpr std::uint8_t kBufferOpen = 1;               ///< 0x60C4:06

/// What an object is called in maxon's documents, e.g. "Interpolation Buffer Status"; empty for objects that
/// are listed neither above nor in `objects.h`.
const char* epos_object_name(canopen::ObjectAddress address);

}  // namespace interpolated_motion::cia402
