#pragma once

#include "interpolated_motion_driver/protocol/canopen/object.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"

namespace interpolated_motion::cia402 {

/// Objects of CiA 402 (and CiA 301) that drives in the cyclic synchronous position mode have and EPOS2 has
/// not, or has in another form. The others: `epos_objects.h`.
namespace object {

inline constexpr canopen::ObjectAddress kCommunicationCyclePeriod{0x1006, 0};  ///< U32, us
inline constexpr canopen::ObjectAddress kFollowingErrorActual{0x60F4, 0};      ///< I32, position units

}  // namespace object

namespace pdo_entry {

inline constexpr canopen::PdoEntry kTargetPosition{{0x607A, 0}, 32};                          ///< 0x607A0020
inline constexpr canopen::PdoEntry kFollowingErrorActual{object::kFollowingErrorActual, 32};  ///< 0x60F40020

}  // namespace pdo_entry

/// EMCY code of a drive whose target positions, or whose SYNC, have failed to come (CiA 402, error codes:
/// sync controller).
namespace emergency_code {
inline constexpr std::uint16_t kSyncController = 0x8700;
}  // namespace emergency_code

}  // namespace interpolated_motion::cia402
