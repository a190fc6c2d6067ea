#include "can_socket.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/sock_diag.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <boost/system/system_error.hpp>

#include "interpolated_motion_driver/transport/host_clock.h"

namespace interpolated_motion::transport {
namespace {

[[noreturn]] void fail(const char* what) {
  throw boost::system::system_error(errno, boost::system::system_category(), what);
}

template <class Value>
void set_option(int fd, int level, int option, const Value& value, const char* what) {
  if (setsockopt(fd, level, option, &value, sizeof value) != 0) fail(what);
}

void set_filters(int fd, const std::vector<CanSocket::Filter>& filters) {
  if (filters.empty()) return;
  std::vector<can_filter> kernel_filters;
  kernel_filters.reserve(filters.size());
  for (const CanSocket::Filter& filter : filters) {
    kernel_filters.push_back({filter.id, filter.mask | CAN_EFF_FLAG});
  }
  const auto bytes = static_cast<socklen_t>(kernel_filters.size() * sizeof(can_filter));
  if (setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, kernel_filters.data(), bytes) != 0) fail("CAN_RAW_FILTER");
}

void set_buffers(int fd, int receive_buffer, int send_buffer) {
  // Beyond net.core.rmem_max for root only.
  if (setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &receive_buffer, sizeof receive_buffer) != 0) {
    set_option(fd, SOL_SOCKET, SO_RCVBUF, receive_buffer, "SO_RCVBUF");
  }
  if (send_buffer > 0) set_option(fd, SOL_SOCKET, SO_SNDBUF, send_buffer, "SO_SNDBUF");
}

void set_options(int fd, bool own_frames) {
  constexpr int kOn = 1;
  const int own = own_frames ? 1 : 0;
  constexpr can_err_mask_t kAllErrors = CAN_ERR_MASK;
  set_option(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, own, "CAN_RAW_RECV_OWN_MSGS");
  set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kAllErrors, "CAN_RAW_ERR_FILTER");
  set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, kOn, "SO_RXQ_OVFL");
  set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, kOn, "SO_TIMESTAMPNS");
}

void bind_to(int fd, int interface_index) {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = interface_index;
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) fail("bind");
}

can_frame to_kernel(const canopen::Frame& frame) {
  can_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
  raw.can_dlc = frame.length;
  std::copy(frame.data.begin(), frame.data.end(), raw.data);
  return raw;
}

canopen::Frame from_kernel(const can_frame& raw) {
  canopen::Frame frame;
  frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
  frame.id = raw.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.length = std::min<std::uint8_t>(raw.can_dlc, CAN_MAX_DLEN);
  if (!frame.remote) std::copy_n(raw.data, frame.length, frame.data.begin());
  return frame;
}

struct Ancillary {
  std::optional<HostDuration> wall_stamp;
  std::optional<std::uint32_t> dropped;
};

Ancillary read_ancillary(msghdr& message) {
  Ancillary found;
  for (cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr; c = CMSG_NXTHDR(&message, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SO_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
      found.wall_stamp = std::chrono::seconds(stamp.tv_sec) + std::chrono::nanoseconds(stamp.tv_nsec);
    } else if (c->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t dropped = 0;
      std::memcpy(&dropped, CMSG_DATA(c), sizeof dropped);
      found.dropped = dropped;
    }
  }
  return found;
}

/// Room for the frames of one recvmmsg() and what the kernel tells about them.
template <std::size_t kCount>
struct Messages {
  using Control = std::array<char, CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t))>;
  struct alignas(cmsghdr) AlignedControl {
    Control bytes;
  };

  std::array<can_frame, kCount> frames{};
  std::array<iovec, kCount> data{};
  std::array<AlignedControl, kCount> control;
  std::array<mmsghdr, kCount> headers{};

  Messages() {
    for (std::size_t i = 0; i < kCount; ++i) {
      data[i] = {&frames[i], sizeof frames[i]};
      headers[i].msg_hdr.msg_iov = &data[i];
      headers[i].msg_hdr.msg_iovlen = 1;
      headers[i].msg_hdr.msg_control = control[i].bytes.data();
      headers[i].msg_hdr.msg_controllen = control[i].bytes.size();
    }
  }
};

int open_socket() {
  const int fd = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (fd < 0) fail("socket");
  return fd;
}

}  // namespace

CanSocket::CanSocket(boost::asio::io_context& io, int interface_index, const std::vector<Filter>& filters,
                     int receive_buffer, int send_buffer, bool own_frames)
    : descriptor_(io) {
  const int fd = open_socket();
  boost::system::error_code refused;
  descriptor_.assign(fd, refused);
  if (refused) {
    close(fd);
    throw boost::system::system_error(refused, "epoll");
  }
  set_options(fd, own_frames);
  set_filters(fd, filters);
  set_buffers(fd, receive_buffer, send_buffer);
  bind_to(fd, interface_index);
}

CanSocket::SendResult CanSocket::send(const canopen::Frame& frame) {
  const can_frame raw = to_kernel(frame);
  ssize_t written = -1;
  do {
    written = write(descriptor_.native_handle(), &raw, sizeof raw);
  } while (written < 0 && errno == EINTR);
  if (written == static_cast<ssize_t>(sizeof raw)) return SendResult::Taken;
  switch (errno) {
    case EAGAIN:
      return SendResult::SocketFull;
    case ENOBUFS:
      return SendResult::QueueFull;
    default:
      return SendResult::Down;
  }
}

std::optional<CanSocket::Received> CanSocket::receive() {
  if (read_ == filled_ && !std::exchange(drained_, false)) fill();
  if (read_ == filled_) {
    drained_ = false;
    return std::nullopt;
  }
  const Received& received = batch_[read_++];
  if (received.dropped) dropped_ = *received.dropped;
  return received;
}

void CanSocket::fill() {
  Messages<kBatch> messages;
  int count = -1;
  do {
    count = recvmmsg(descriptor_.native_handle(), messages.headers.data(), kBatch, 0, nullptr);
  } while (count < 0 && errno == EINTR);
  read_ = filled_ = 0;
  drained_ = true;
  if (count < 0 && errno == EAGAIN) return;
  if (count < 0) {
    batch_[filled_++] = Received{{}, 0, {}, true};
    return;
  }
  const HostTime before = read_host_clock();
  const HostDuration wall = read_wall_clock();
  const HostTime now = read_host_clock();
  wall_clock_.measure(before, wall, now);
  filled_ = static_cast<std::size_t>(count);
  drained_ = filled_ < kBatch;
  for (std::size_t i = 0; i < filled_; ++i) {
    msghdr& header = messages.headers[i].msg_hdr;
    const can_frame& raw = messages.frames[i];
    const Ancillary ancillary = read_ancillary(header);
    // Stamps may come from several processors: time must not run back.
    const HostTime time = ancillary.wall_stamp ? wall_clock_.host_time_of(*ancillary.wall_stamp) : now;
    last_time_ = std::max(last_time_, time);
    const bool is_error = (raw.can_id & CAN_ERR_FLAG) != 0;
    const bool own = (header.msg_flags & MSG_CONFIRM) != 0;
    batch_[i] = Received{{from_kernel(raw), last_time_, own},
                         is_error ? raw.can_id & CAN_ERR_MASK : 0U,
                         ancillary.dropped,
                         false};
  }
}

std::uint32_t CanSocket::dropped() {
  // A frame carries the count as it was when that frame came; after the last frame only this tells.
  std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
  socklen_t length = sizeof memory;
  if (getsockopt(descriptor_.native_handle(), SOL_SOCKET, SO_MEMINFO, memory.data(), &length) == 0 &&
      length > SK_MEMINFO_DROPS * sizeof(std::uint32_t)) {
    dropped_ = memory[SK_MEMINFO_DROPS];
  }
  return dropped_;
}

int CanSocket::receive_buffer() {
  int bytes = 0;
  socklen_t length = sizeof bytes;
  getsockopt(descriptor_.native_handle(), SOL_SOCKET, SO_RCVBUF, &bytes, &length);
  return bytes;
}

}  // namespace interpolated_motion::transport
