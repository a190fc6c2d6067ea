#pragma once

#include <string>
#include <system_error>

#include <boost/system/error_code.hpp>

#include "interpolated_motion_driver/transport/socketcan_bus.h"

/// Sentences of SocketcanBus for the user, each with the command that helps.
namespace interpolated_motion::transport {

std::string missing_text(const std::string& interface);
std::string unknown_text(const std::string& interface, const std::error_code& error);
std::string down_text(const CanInterface& interface, std::uint32_t bitrate);
std::string up_text(const CanInterface& interface);
std::string bus_off_text(const CanInterface& interface);
std::string open_error_text(const std::string& interface, const boost::system::error_code& error);

/// Throws std::invalid_argument naming parameter, value and range.
void validate(const SocketcanParameters& parameters);

}  // namespace interpolated_motion::transport
