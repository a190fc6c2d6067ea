#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/axis/cyclic/cyclic_parameters.h"
#include "interpolated_motion_driver/protocol/cia402/identity.h"

namespace interpolated_motion::axis {

/// What a bring-up has found out about a cyclic drive.
struct CyclicFacts {
  bool takes_velocity = false;  ///< 0x60B1 goes with each target position
  bool takes_torque = false;    ///< 0x60B2 goes with each target position
};

/// The reads and writes that identify, verify and parameterise a cyclic drive in Pre-operational. The
/// identity goes to `identity`, what is found out to `facts`; both and `sequence`, whose last steps these
/// must be, must outlive it. Needed: 0x6060..0x6065, 0x607A, 0x60C2 and a 0x6502 with mode 8; what a drive
/// may lack (0x1006, 0x6007, 0x605E, 0x607D, 0x6084, 0x6085, 0x60B1, 0x60B2) is set, or mapped, where it is
/// there.
std::vector<SdoSequence::Step> cyclic_bring_up_steps(const CyclicAxisParameters& parameters,
                                                     std::uint8_t node, cia402::Identity& identity,
                                                     SdoSequence& sequence, CyclicFacts& facts);

/// 0x607D, where the drive has it, for a joint that stands at `present` (rad), see `position_limits`.
std::vector<SdoSequence::Step> cyclic_position_limit_steps(const CyclicAxisParameters& parameters,
                                                           std::optional<double> present);

}  // namespace interpolated_motion::axis
