#pragma once

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace interpolated_motion::transport {

/// Another program on the bus: a socket as candump and cansend use it.
class RawCan {
 public:
  explicit RawCan(const std::string& interface) : fd_(socket(PF_CAN, SOCK_RAW, CAN_RAW)) {
    constexpr int kOn = 1;
    constexpr int kBuffer = 16 << 20;
    setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &kOn, sizeof kOn);
    setsockopt(fd_, SOL_SOCKET, SO_RCVBUFFORCE, &kBuffer, sizeof kBuffer);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0)
        << interface << ": " << std::strerror(errno);
  }
  ~RawCan() { close(fd_); }
  RawCan(const RawCan&) = delete;
  RawCan& operator=(const RawCan&) = delete;

  /// `id` with the kernel's flags; the first data bytes hold `number`.
  bool send(std::uint32_t id, std::uint32_t number = 0) {
    can_frame frame{};
    frame.can_id = id;
    frame.can_dlc = 8;
    std::memcpy(frame.data, &number, sizeof number);
    return write(fd_, &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame);
  }

  bool send_fd(std::uint32_t id) {
    canfd_frame frame{};
    frame.can_id = id;
    frame.len = 64;
    return write(fd_, &frame, sizeof frame) == static_cast<ssize_t>(sizeof frame);
  }

  /// Waits up to a second for the next frame.
  std::optional<can_frame> receive(int timeout_ms = 1000) {
    pollfd wait{fd_, POLLIN, 0};
    if (poll(&wait, 1, timeout_ms) != 1) return std::nullopt;
    can_frame frame{};
    if (read(fd_, &frame, sizeof frame) != static_cast<ssize_t>(sizeof frame)) return std::nullopt;
    return frame;
  }

 private:
  int fd_;
};

}  // namespace interpolated_motion::transport
