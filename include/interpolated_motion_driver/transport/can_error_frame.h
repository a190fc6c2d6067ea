#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

/// What a CAN controller reports about its bus: the contents of a SocketCAN error frame (linux/can/error.h).
/// One report may carry several findings.
struct CanErrorReport {
  HostTime time{};                  ///< at which the frame was received
  bool transmit_timeout = false;    ///< a frame could not be sent in time (reported by the driver)
  bool arbitration_lost = false;    ///< harmless: the frame is sent again
  bool receive_overflow = false;    ///< the controller has lost received frames
  bool transmit_overflow = false;   ///< the controller has lost frames to send
  bool error_warning = false;       ///< an error counter has reached 96
  bool error_passive = false;       ///< an error counter has passed 127
  bool error_active = false;        ///< both counters are below 96 again
  bool protocol_violation = false;  ///< bit, form or stuff error
  bool transceiver = false;         ///< the transceiver finds the wires broken or shorted
  bool no_acknowledge = false;      ///< nobody has acknowledged a frame
  bool bus_off = false;    ///< the transmit error counter has passed 255: the controller is off the bus
  bool bus_error = false;  ///< a disturbance that the controller does not classify
  bool restarted = false;  ///< back on the bus after bus-off
  std::optional<std::uint8_t> transmit_errors;  ///< error counters, where the driver tells them
  std::optional<std::uint8_t> receive_errors;   ///< likewise
};

/// Decodes an error frame: `classes` is its identifier without flags.
CanErrorReport decode_can_error(std::uint32_t classes, const std::array<std::uint8_t, 8>& data);

/// The findings in words, most serious first: "bus-off, no acknowledgement (error counters: transmit 248,
/// receive 0)".
std::string to_string(const CanErrorReport& report);

}  // namespace interpolated_motion::transport
