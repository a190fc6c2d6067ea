// The question RTM_GETLINK and its answer, rtnetlink(7); attributes of CAN interfaces: linux/can/netlink.h.

#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/if.h>
#include <linux/if_arp.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "interpolated_motion_driver/transport/can_interface.h"

namespace interpolated_motion::transport {
namespace {

constexpr std::size_t kAnswerBytes = 32768;  // as iproute2 reserves

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

struct Request {
  nlmsghdr header;
  ifinfomsg info;
  rtattr name_header;
  std::array<char, IFNAMSIZ> name;
};

Request request_for(const std::string& name) {
  Request request{};
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.info.ifi_family = AF_UNSPEC;
  request.name_header.rta_type = IFLA_IFNAME;
  request.name_header.rta_len = static_cast<unsigned short>(RTA_LENGTH(request.name.size()));
  std::copy(name.begin(), name.end(), request.name.begin());
  return request;
}

template <class Value>
Value value_of(const rtattr* attribute) {
  Value value{};
  std::memcpy(&value, RTA_DATA(attribute), std::min<std::size_t>(sizeof value, RTA_PAYLOAD(attribute)));
  return value;
}

std::string text_of(const rtattr* attribute) {
  const char* data = static_cast<const char*>(RTA_DATA(attribute));
  return std::string(data, strnlen(data, RTA_PAYLOAD(attribute)));
}

template <class Visit>
void for_each_attribute(const rtattr* attribute, std::size_t length, Visit visit) {
  auto left = static_cast<unsigned>(length);
  for (; RTA_OK(attribute, left); attribute = RTA_NEXT(attribute, left)) visit(attribute);
}

template <class Visit>
void for_each_nested(const rtattr* outer, Visit visit) {
  for_each_attribute(static_cast<const rtattr*>(RTA_DATA(outer)), RTA_PAYLOAD(outer), visit);
}

std::optional<CanControllerState> controller_state(std::uint32_t value) {
  switch (value) {
    case CAN_STATE_ERROR_ACTIVE:
      return CanControllerState::ErrorActive;
    case CAN_STATE_ERROR_WARNING:
      return CanControllerState::ErrorWarning;
    case CAN_STATE_ERROR_PASSIVE:
      return CanControllerState::ErrorPassive;
    case CAN_STATE_BUS_OFF:
      return CanControllerState::BusOff;
    case CAN_STATE_STOPPED:
      return CanControllerState::Stopped;
    case CAN_STATE_SLEEPING:
      return CanControllerState::Sleeping;
    default:
      return std::nullopt;
  }
}

void read_can_data(const rtattr* attribute, CanInterface& interface) {
  switch (attribute->rta_type) {
    case IFLA_CAN_BITTIMING: {
      const std::uint32_t bitrate = value_of<can_bittiming>(attribute).bitrate;
      if (bitrate != 0) interface.bitrate = bitrate;
      break;
    }
    case IFLA_CAN_STATE:
      interface.controller = controller_state(value_of<std::uint32_t>(attribute));
      break;
    case IFLA_CAN_RESTART_MS:
      interface.restart_ms = value_of<std::uint32_t>(attribute);
      break;
    case IFLA_CAN_CTRLMODE:
      interface.listen_only = (value_of<can_ctrlmode>(attribute).flags & CAN_CTRLMODE_LISTENONLY) != 0;
      break;
    default:
      break;
  }
}

void read_link_info(const rtattr* info, CanInterface& interface) {
  for_each_nested(info, [&interface](const rtattr* attribute) {
    if (attribute->rta_type == IFLA_INFO_KIND) interface.kind = text_of(attribute);
  });
  // All drivers with bit timing have the kind "can".
  if (interface.kind != "can") return;
  for_each_nested(info, [&interface](const rtattr* attribute) {
    if (attribute->rta_type != IFLA_INFO_DATA) return;
    for_each_nested(attribute, [&interface](const rtattr* data) { read_can_data(data, interface); });
  });
}

CanInterface read_link(const nlmsghdr* message) {
  const auto* info = static_cast<const ifinfomsg*>(NLMSG_DATA(message));
  CanInterface interface;
  interface.index = info->ifi_index;
  interface.up = (info->ifi_flags & IFF_UP) != 0;
  interface.can = info->ifi_type == ARPHRD_CAN;
  for_each_attribute(IFLA_RTA(info), IFLA_PAYLOAD(message), [&interface](const rtattr* attribute) {
    // NLA_F_NESTED may be set on the type.
    switch (attribute->rta_type & NLA_TYPE_MASK) {
      case IFLA_IFNAME:
        interface.name = text_of(attribute);
        break;
      case IFLA_MTU:
        interface.fd = value_of<std::uint32_t>(attribute) >= CANFD_MTU;
        break;
      case IFLA_TXQLEN:
        interface.transmit_queue = value_of<std::uint32_t>(attribute);
        break;
      case IFLA_LINKINFO:
        read_link_info(attribute, interface);
        break;
      default:
        break;
    }
  });
  return interface;
}

std::error_code of_system(int error) { return {error, std::system_category()}; }

/// Of a message that is no description of a link.
std::error_code refusal_of(const nlmsghdr* message) {
  const bool tells =
      message->nlmsg_type == NLMSG_ERROR && message->nlmsg_len >= NLMSG_LENGTH(sizeof(nlmsgerr));
  return of_system(tells ? -static_cast<const nlmsgerr*>(NLMSG_DATA(message))->error : EBADMSG);
}

}  // namespace

Expected<CanInterface, std::error_code> read_can_interface(const std::string& name) {
  if (name.empty() || name.size() >= IFNAMSIZ) return of_system(ENODEV);
  const Descriptor netlink(socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  if (netlink.get() < 0) return of_system(errno);
  const Request request = request_for(name);
  if (::send(netlink.get(), &request, sizeof request, 0) < 0) return of_system(errno);
  alignas(nlmsghdr) std::array<char, kAnswerBytes> answer;
  // The kernel has answered by the time send() returns.
  const ssize_t length = recv(netlink.get(), answer.data(), answer.size(), MSG_DONTWAIT);
  if (length < 0) return of_system(errno);
  const auto* message = reinterpret_cast<const nlmsghdr*>(answer.data());
  if (!NLMSG_OK(message, static_cast<unsigned>(length))) return of_system(EBADMSG);
  if (message->nlmsg_type != RTM_NEWLINK) return refusal_of(message);
  return read_link(message);
}

}  // namespace interpolated_motion::transport
