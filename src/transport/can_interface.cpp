#include "interpolated_motion_driver/transport/can_interface.h"

#include <fmt/format.h>

namespace interpolated_motion::transport {
namespace {

bool has_bit_timing(const CanInterface& interface) {
  return interface.kind != "vcan" && interface.kind != "vxcan";
}

}  // namespace

std::string bring_up_command(const CanInterface& interface, std::uint32_t bitrate) {
  std::string command = fmt::format("sudo ip link set dev {} up", interface.name);
  if (!has_bit_timing(interface) || bitrate == 0) return command;
  return fmt::format("{} type can bitrate {} restart-ms 100", command, bitrate);
}

std::string interface_fault(const CanInterface& interface, std::uint32_t bitrate) {
  if (!interface.can) {
    return fmt::format("{} is a network interface, but not one of CAN; ip -br link show type can lists those",
                       interface.name);
  }
  if (interface.listen_only) {
    return fmt::format("{} is in listen-only mode and cannot send: sudo ip link set dev {} down && {}",
                       interface.name, interface.name,
                       bring_up_command(interface, bitrate) + " listen-only off");
  }
  if (bitrate != 0 && interface.bitrate && *interface.bitrate != bitrate) {
    return fmt::format(
        "{} runs at {} bit/s, but the configuration says {} bit/s; sending would disturb the bus: sudo ip "
        "link "
        "set dev {} down && {}",
        interface.name, *interface.bitrate, bitrate, interface.name, bring_up_command(interface, bitrate));
  }
  return {};
}

std::vector<std::string> interface_advice(const CanInterface& interface, std::uint32_t transmit_queue) {
  std::vector<std::string> advice;
  if (has_bit_timing(interface) && interface.transmit_queue < transmit_queue) {
    advice.push_back(
        fmt::format("the transmit queue of {} holds {} frames only, so frames wait in the driver: sudo ip "
                    "link set dev {} "
                    "txqueuelen {}",
                    interface.name, interface.transmit_queue, interface.name, transmit_queue));
  }
  if (interface.restart_ms && *interface.restart_ms == 0) {
    advice.push_back(fmt::format(
        "{} stays off after bus-off: sudo ip link set dev {} down && sudo ip link set dev {} up type can "
        "restart-ms 100",
        interface.name, interface.name, interface.name));
  }
  return advice;
}

}  // namespace interpolated_motion::transport
