#pragma once

#include <cstdint>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"
#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::transport {

/// A further node on a virtual bus, which nobody has reckoned with: it sends what it is told to, and repeats
/// what others have sent, as a second device with their identifier would.
class Stranger final : public CanListener {
 public:
  /// Joins `bus`, which must outlive it.
  explicit Stranger(VirtualCanBus& bus) : bus_(bus), port_(bus.add_port(*this)) {}

  /// False, and nothing sent, when too many of its frames wait.
  bool send(const canopen::Frame& frame, HostTime now) { return bus_.send(port_, frame, now); }

  /// The next `count` frames of others with identifier `id` are sent once more.
  void repeat(std::uint32_t id, int count) {
    repeated_id_ = id;
    repetitions_ = count;
  }

  void on_can_frame(const canopen::Frame& frame, HostTime time) override {
    if (repetitions_ <= 0 || frame.id != repeated_id_ || frame.extended) return;
    --repetitions_;
    bus_.send(port_, frame, time);
  }

 private:
  VirtualCanBus& bus_;
  int port_;
  std::uint32_t repeated_id_ = 0;
  int repetitions_ = 0;
};

}  // namespace interpolated_motion::transport
