#pragma once

#include <string>

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::canopen {

/// A frame as candump and cansend write it: "603#4041600000000000", "189#R", "00012345#01".
std::string to_string(const Frame& frame);

}  // namespace interpolated_motion::canopen
