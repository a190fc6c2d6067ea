#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/transport/can_error_frame.h"
#include "interpolated_motion_driver/transport/can_interface.h"

namespace interpolated_motion::commissioning {

/// What a CAN controller has reported, all reports together.
struct BusErrors {
  std::uint64_t no_acknowledge = 0;  ///< reports of each kind
  std::uint64_t disturbed = 0;       ///< bit, form and stuff errors, and unclassified ones
  std::uint64_t bus_off = 0;
  std::string last;  ///< the last report in words

  void add(const transport::CanErrorReport& report);
};

/// "can0: 500000 bit/s, error-active", "vcan0: virtual, without a bit rate".
std::string describe_interface(const transport::CanInterface& interface);

/// Why nobody has answered on a bus, in sentences, with what to do. `heard`: frames of others.
std::vector<std::string> silent_bus_advice(const transport::CanInterface& interface, const BusErrors& errors,
                                           std::uint64_t heard);

}  // namespace interpolated_motion::commissioning
