#pragma once

#include <cstdint>
#include <vector>

#include "interpolated_motion_driver/axis/cia402/sdo_sequence.h"
#include "interpolated_motion_driver/protocol/canopen/pdo.h"

namespace interpolated_motion::axis {

/// Reads back how PDOs of a drive are set up: a vendor's tool that is plugged in changes them, and then a
/// drive takes a controlword for something else. The sequence ends with a sentence where identifier, objects
/// or transmission type are not those of `wanted`; times are not looked at, drives may round them.
std::vector<SdoSequence::Step> pdo_check(const std::vector<canopen::PdoConfiguration>& wanted,
                                         std::uint8_t node);

}  // namespace interpolated_motion::axis
