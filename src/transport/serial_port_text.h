#pragma once

#include <string>

#include "interpolated_motion_driver/transport/serial_port_line.h"

/// Sentences of SerialPortLine for the user, each with what helps.
namespace interpolated_motion::transport {

/// Why the device could not be opened or set up; `error` is an errno.
std::string open_error_text(const SerialPortParameters& parameters, int error);

/// Throws std::invalid_argument naming parameter, value and range.
void validate(const SerialPortParameters& parameters);

}  // namespace interpolated_motion::transport
