#pragma once

#include <optional>
#include <string>

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::transport {

/// The frame that is written as candump and cansend do, "000#8002", "189#R": three or eight hexadecimal
/// digits of an identifier, 0..7FF or 0..1FFFFFFF, '#', and 'R' or 0..8 bytes of two digits each. Empty when
/// it is none.
std::optional<canopen::Frame> parse_frame(const std::string& text);

}  // namespace interpolated_motion::transport
