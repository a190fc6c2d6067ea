#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "interpolated_motion_driver/units/expected.h"

namespace interpolated_motion::transport {

/// State of a CAN controller (ISO 11898-1, fault confinement), as the kernel reports it.
enum class CanControllerState { ErrorActive, ErrorWarning, ErrorPassive, BusOff, Stopped, Sleeping };

/// A network interface as rtnetlink describes it.
struct CanInterface {
  std::string name;                  ///< as `ip link` shows it: "can0"
  int index = 0;                     ///< changes when an interface is removed and comes back
  bool up = false;                   ///< switched on by `ip link set ... up`
  bool can = false;                  ///< a CAN interface at all
  bool fd = false;                   ///< takes CAN FD frames too; classic ones travel over it all the same
  std::string kind;                  ///< "vcan", "vxcan", "can", "slcan"; empty when the driver does not say
  std::uint32_t transmit_queue = 0;  ///< txqueuelen, frames
  std::optional<std::uint32_t> bitrate;          ///< bit/s; none for interfaces without bit timing, as vcan
  std::optional<CanControllerState> controller;  ///< none where there is no controller, as vcan
  std::optional<std::uint32_t> restart_ms;       ///< pause before the kernel ends bus-off; 0: never by itself
  bool listen_only = false;                      ///< it does not send, nor acknowledge
};

/// Asks the kernel about an interface. The error is std::errc::no_such_device when there is none of that
/// name; any other says why the kernel could not be asked. Does not wait for hardware.
Expected<CanInterface, std::error_code> read_can_interface(const std::string& name);

/// Command that switches an interface on: "sudo ip link set dev can0 up type can bitrate 1000000
/// restart-ms 100". `bitrate` 0 and virtual interfaces: without bit rate.
std::string bring_up_command(const CanInterface& interface, std::uint32_t bitrate);

/// Why an interface must not be used for a bus of `bitrate` bit/s (0: any), in one sentence with the command
/// that helps; empty when nothing is wrong. That it is down is not among the reasons.
std::string interface_fault(const CanInterface& interface, std::uint32_t bitrate);

/// Sentences on settings that work but could be better: a transmit queue shorter than `transmit_queue`
/// frames, no automatic restart after bus-off.
std::vector<std::string> interface_advice(const CanInterface& interface, std::uint32_t transmit_queue);

}  // namespace interpolated_motion::transport
