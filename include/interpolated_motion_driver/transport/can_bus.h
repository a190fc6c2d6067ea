#pragma once

#include <optional>

#include "interpolated_motion_driver/protocol/canopen/frame.h"

namespace interpolated_motion::transport {

/// One CAN bus as the host sees it. Never blocks. The only two things that can be done with a bus are below;
/// an implementation is a socket, or a modelled bus with emulated drives on it.
class CanBus {
 public:
  virtual ~CanBus() = default;

  /// Puts a frame into the transmit queue. Returns false, and takes nothing, when the queue is full or the
  /// interface is down: the caller keeps the frame and tries again later. Frames leave in the order given.
  virtual bool send(const canopen::Frame& frame, HostTime now) = 0;

  /// The next frame seen on the bus, oldest first: those of other nodes, and this host's own once they have
  /// been transmitted (`own` is set). Empty when there is none.
  virtual std::optional<canopen::ReceivedFrame> receive() = 0;
};

}  // namespace interpolated_motion::transport
