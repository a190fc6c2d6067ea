#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/transport/wall_clock_offset.h"

namespace interpolated_motion::transport {

/// A CAN_RAW socket bound to one interface (linux/can/raw.h): the system calls of SocketcanBus. It hears
/// error frames and, if so opened, its own frames once they have been sent.
class CanSocket {
 public:
  enum class SendResult {
    Taken,
    SocketFull,  ///< the socket's own buffer is full: it becomes writable again
    QueueFull,   ///< the interface's queue is full: the socket does not tell when there is room again
    Down,        ///< the interface is down or gone
  };

  /// What was read: a frame, an error frame (`error_classes` set, contents in `frame.frame.data`), or news
  /// that the interface is down or gone.
  struct Received {
    canopen::ReceivedFrame frame;
    std::uint32_t error_classes = 0;
    std::optional<std::uint32_t> dropped;  ///< frames the kernel had no room for until this one came
    bool down = false;
  };

  /// Identifier and mask of frames to receive, standard format only.
  struct Filter {
    std::uint32_t id = 0;
    std::uint32_t mask = 0;
  };

  /// Opens and binds. `filters` empty: every frame. Throws boost::system::system_error.
  CanSocket(boost::asio::io_context& io, int interface_index, const std::vector<Filter>& filters,
            int receive_buffer, int send_buffer, bool own_frames);

  SendResult send(const canopen::Frame& frame);
  /// The next one there is. When it returns none, all that was there at the latest look at the kernel has
  /// been taken: more may have come since, which a wait for readability tells at once.
  std::optional<Received> receive();

  /// Received frames that the kernel had no room for, since the socket was opened. Asks the kernel.
  std::uint32_t dropped();
  /// The same as the last frame received has told it: frames lost after that one are not in it.
  std::uint32_t known_dropped() const { return dropped_; }

  /// Size of the receive buffer the kernel has granted, bytes.
  int receive_buffer();

  boost::asio::posix::stream_descriptor& descriptor() { return descriptor_; }

 private:
  /// Frames taken from the kernel at a time: a burst of answers to one SYNC.
  static constexpr std::size_t kBatch = 32;

  void fill();

  boost::asio::posix::stream_descriptor descriptor_;
  std::uint32_t dropped_ = 0;
  WallClockOffset wall_clock_;
  HostTime last_time_{};
  std::array<Received, kBatch> batch_;
  std::size_t read_ = 0;
  std::size_t filled_ = 0;
  bool drained_ = false;  ///< the latest batch was not full
};

}  // namespace interpolated_motion::transport
