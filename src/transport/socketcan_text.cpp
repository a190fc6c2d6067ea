#include "socketcan_text.h"

#include <stdexcept>

#include <fmt/format.h>
#include <boost/system/error_code.hpp>

namespace interpolated_motion::transport {
namespace {

constexpr std::size_t kLongestName = 15;  // IFNAMSIZ - 1
constexpr std::uint32_t kHighestBitrate = 1'000'000;
constexpr int kHighestNodeId = 127;
constexpr std::uint32_t kHighestStandardId = 0x7FF;

[[noreturn]] void refuse(const SocketcanParameters& parameters, const std::string& what) {
  throw std::invalid_argument(fmt::format("CAN interface \"{}\": {}", parameters.interface, what));
}

}  // namespace

std::string missing_text(const std::string& interface) {
  const std::string virtual_one =
      fmt::format("sudo ip link add dev {0} type vcan && sudo ip link set dev {0} up", interface);
  if (interface.rfind("vcan", 0) == 0) {
    return fmt::format("there is no CAN interface {}: {}", interface, virtual_one);
  }
  return fmt::format(
      "there is no CAN interface {}: plug the adapter in, or see what there is with ip -br link show type "
      "can "
      "(without an adapter: {})",
      interface, virtual_one);
}

std::string unknown_text(const std::string& interface, const std::error_code& error) {
  return fmt::format("CAN interface {}: the kernel cannot be asked about it: {}", interface, error.message());
}

std::string down_text(const CanInterface& interface, std::uint32_t bitrate) {
  return fmt::format("CAN interface {} is down: {}", interface.name, bring_up_command(interface, bitrate));
}

std::string up_text(const CanInterface& interface) {
  const std::string rate =
      interface.bitrate ? fmt::format(" at {} bit/s", *interface.bitrate) : std::string(" without bit rate");
  return fmt::format("CAN interface {} is up{}", interface.name, rate);
}

std::string bus_off_text(const CanInterface& interface) {
  const std::string what = fmt::format(
      "CAN interface {} is off the bus after too many errors; check bit rate, wiring and both terminations",
      interface.name);
  if (interface.restart_ms && *interface.restart_ms > 0) {
    return fmt::format("{}; it tries again after {} ms", what, *interface.restart_ms);
  }
  return fmt::format("{}, then: sudo ip link set dev {} type can restart", what, interface.name);
}

std::string open_error_text(const std::string& interface, const boost::system::error_code& error) {
  if (error == boost::system::errc::address_family_not_supported ||
      error == boost::system::errc::protocol_not_supported) {
    return fmt::format(
        "CAN interface {} cannot be opened, the kernel lacks raw CAN sockets: sudo modprobe can_raw",
        interface);
  }
  if (error == boost::system::errc::operation_not_permitted ||
      error == boost::system::errc::permission_denied) {
    return fmt::format(
        "CAN interface {} cannot be opened, CAN sockets are not permitted here: allow them to this container "
        "or "
        "service",
        interface);
  }
  return fmt::format("CAN interface {} cannot be opened: {}", interface, error.message());
}

void validate(const SocketcanParameters& p) {
  if (p.interface.empty() || p.interface.size() > kLongestName) {
    refuse(p, fmt::format("a name has 1..{} characters, as ip -br link shows it", kLongestName));
  }
  if (p.bitrate > kHighestBitrate) {
    refuse(p, fmt::format("bitrate is {} bit/s; allowed: up to {}, 0 for any", p.bitrate, kHighestBitrate));
  }
  for (const std::uint8_t id : p.node_ids) {
    if (id > kHighestNodeId) refuse(p, fmt::format("node_ids has {}; allowed: 0..{}", id, kHighestNodeId));
  }
  for (const std::uint32_t id : p.further_ids) {
    if (id > kHighestStandardId) refuse(p, fmt::format("further_ids has {:#x}; allowed: 0..0x7ff", id));
  }
  if (p.receive_buffer < 1)
    refuse(p, fmt::format("receive_buffer is {}; allowed: 1 and more", p.receive_buffer));
  if (p.send_buffer < 0) refuse(p, fmt::format("send_buffer is {}; allowed: 0 and more", p.send_buffer));
  if (p.transmit_limit < 1) refuse(p, "transmit_limit is 0; allowed: 1 and more");
}

}  // namespace interpolated_motion::transport
