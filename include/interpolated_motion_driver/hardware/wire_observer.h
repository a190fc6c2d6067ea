#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// One line of text that has crossed a serial line.
struct SerialText {
  std::string_view text;  ///< without the CR that ends it
  HostTime time{};        ///< of the CR's last bit
  bool from_host = false;
};

/// Watches everything that crosses the buses, in the order of the wire. Either function may be empty.
struct WireObserver {
  std::function<void(const std::string& bus, const canopen::ReceivedFrame&)> frame;
  std::function<void(const std::string& bus, const SerialText&)> text;
};

}  // namespace interpolated_motion::hardware
