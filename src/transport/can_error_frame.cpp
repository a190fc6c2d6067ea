#include "interpolated_motion_driver/transport/can_error_frame.h"

#include <linux/can.h>
#include <linux/can/error.h>

#include <fmt/format.h>

namespace interpolated_motion::transport {
namespace {

// Linux 6.0 and later mark the presence of error counters; earlier ones fill them in along with the state.
constexpr std::uint32_t kCountersValid = 0x200;  // CAN_ERR_CNT

void decode_controller(std::uint8_t status, CanErrorReport& report) {
  constexpr std::uint8_t kActive = 0x40;  // CAN_ERR_CRTL_ACTIVE
  report.receive_overflow = (status & CAN_ERR_CRTL_RX_OVERFLOW) != 0;
  report.transmit_overflow = (status & CAN_ERR_CRTL_TX_OVERFLOW) != 0;
  report.error_warning = (status & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0;
  report.error_passive = (status & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0;
  report.error_active = (status & kActive) != 0;
}

}  // namespace

CanErrorReport decode_can_error(std::uint32_t classes, const std::array<std::uint8_t, 8>& data) {
  CanErrorReport report;
  report.transmit_timeout = (classes & CAN_ERR_TX_TIMEOUT) != 0;
  report.arbitration_lost = (classes & CAN_ERR_LOSTARB) != 0;
  if ((classes & CAN_ERR_CRTL) != 0) decode_controller(data[1], report);
  report.protocol_violation = (classes & CAN_ERR_PROT) != 0;
  report.transceiver = (classes & CAN_ERR_TRX) != 0;
  report.no_acknowledge = (classes & CAN_ERR_ACK) != 0;
  report.bus_off = (classes & CAN_ERR_BUSOFF) != 0;
  report.bus_error = (classes & CAN_ERR_BUSERROR) != 0;
  report.restarted = (classes & CAN_ERR_RESTARTED) != 0;
  const bool old_style = (classes & CAN_ERR_CRTL) != 0 && (data[6] != 0 || data[7] != 0);
  if ((classes & kCountersValid) != 0 || old_style) {
    report.transmit_errors = data[6];
    report.receive_errors = data[7];
  }
  return report;
}

std::string to_string(const CanErrorReport& report) {
  std::string text;
  const auto add = [&text](bool found, const char* words) {
    if (!found) return;
    if (!text.empty()) text += ", ";
    text += words;
  };
  add(report.bus_off, "bus-off");
  add(report.error_passive, "error passive");
  add(report.error_warning, "many errors (warning level)");
  add(report.transceiver, "transceiver reports a wire fault");
  add(report.no_acknowledge, "no acknowledgement");
  add(report.receive_overflow, "controller lost received frames");
  add(report.transmit_overflow, "controller lost frames to send");
  add(report.transmit_timeout, "transmission timed out");
  add(report.protocol_violation, "protocol violation");
  add(report.arbitration_lost, "arbitration lost");
  add(report.bus_error, "bus error");
  add(report.restarted, "restarted after bus-off");
  add(report.error_active, "error active again");
  if (text.empty()) text = "unspecified error";
  if (report.transmit_errors && report.receive_errors) {
    text += fmt::format(" (error counters: transmit {}, receive {})", *report.transmit_errors,
                        *report.receive_errors);
  }
  return text;
}

}  // namespace interpolated_motion::transport
