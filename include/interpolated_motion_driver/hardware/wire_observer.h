#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::hardware {

/// One line of text that has crossed a serial line.
struct SerialText {
  std::string_view text;   ///< without the CR that ends it
  HostTime time{};         ///< of the CR's last bit
  bool from_host = false;  ///< else from a drive
};

/// Watches everything that crosses the buses, in the order of the wire. Either function may be empty.
struct WireObserver {
  /// On CANopen: frames of this host too, once they have been on the bus.
  std::function<void(const std::string& bus, const canopen::ReceivedFrame&)> frame;
  /// On a serial line: whole lines, those of drives when their CR has come.
  std::function<void(const std::string& bus, const SerialText&)> text;
};

}  // namespace interpolated_motion::hardware
