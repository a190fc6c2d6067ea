#include "interpolated_motion_driver/commissioning/bus_advice.h"

#include <fmt/format.h>

namespace interpolated_motion::commissioning {
namespace {

using transport::CanControllerState;
using transport::CanInterface;

/// Those of CiA 301, table 1, most used first.
constexpr const char* kRates = "1000000, 500000, 250000, 125000, 800000, 50000, 20000, 10000";

const char* state_name(CanControllerState state) {
  switch (state) {
    case CanControllerState::ErrorActive:
      return "error-active";
    case CanControllerState::ErrorWarning:
      return "error-warning";
    case CanControllerState::ErrorPassive:
      return "error-passive";
    case CanControllerState::BusOff:
      return "bus-off";
    case CanControllerState::Stopped:
      return "stopped";
    case CanControllerState::Sleeping:
      return "sleeping";
  }
  return "in an unknown state";
}

std::string rate_advice(const CanInterface& interface) {
  if (!interface.bitrate) return "";
  const std::uint32_t other = *interface.bitrate == 1'000'000 ? 500'000 : 1'000'000;
  return fmt::format(
      "{0} has {1} bit/s. Rates of CANopen are {2}; to try another one: sudo ip link set dev {0} down && {3}",
      interface.name, *interface.bitrate, kRates, transport::bring_up_command(interface, other));
}

}  // namespace

void BusErrors::add(const transport::CanErrorReport& report) {
  no_acknowledge += report.no_acknowledge ? 1 : 0;
  disturbed += report.protocol_violation || report.bus_error ? 1 : 0;
  bus_off += report.bus_off ? 1 : 0;
  last = transport::to_string(report);
}

std::string describe_interface(const CanInterface& interface) {
  if (!interface.bitrate)
    return interface.name + ": without a bit rate of its own, as virtual interfaces are";
  std::string text = fmt::format("{}: {} bit/s", interface.name, *interface.bitrate);
  if (interface.controller) text += fmt::format(", controller {}", state_name(*interface.controller));
  return text;
}

std::vector<std::string> silent_bus_advice(const CanInterface& interface, const BusErrors& errors,
                                           std::uint64_t heard) {
  std::vector<std::string> texts;
  if (errors.disturbed + errors.bus_off > 0 && heard == 0) {
    texts.push_back(
        fmt::format("{}: no frame could be read, and the controller reports errors (last: {}). This is what "
                    "a wrong bit rate "
                    "looks like, or wires that are exchanged or not terminated.",
                    interface.name, errors.last));
  } else if (errors.no_acknowledge > 0) {
    texts.push_back(fmt::format(
        "{}: nobody acknowledges what is sent (last report: {}). No node is powered, the cable is not "
        "connected, or every node has another bit rate.",
        interface.name, errors.last));
  } else if (heard > 0) {
    texts.push_back(
        fmt::format("{}: frames are heard, so the bit rate is right, but no node answers an SDO request.",
                    interface.name));
  } else if (!interface.bitrate) {
    texts.push_back(fmt::format("{}: the bus is silent. No program serves drives on it.", interface.name));
  } else {
    texts.push_back(
        fmt::format("{}: the bus is silent. Check the power of the drives, the cable, the termination (120 "
                    "Ohm at both ends) "
                    "and the bit rate.",
                    interface.name));
  }
  const std::string rate = heard > 0 ? "" : rate_advice(interface);
  if (!rate.empty()) texts.push_back(rate);
  return texts;
}

}  // namespace interpolated_motion::commissioning
