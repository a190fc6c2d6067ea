#pragma once

#include "fuzz/support/fuzz_input.h"
#include "interpolated_motion_driver/transport/virtual_can_bus.h"

namespace interpolated_motion::fuzz {

/// A frame in the fuzzer's bytes: a word, whose lower 11 bits are the identifier (0x1000 adds bits for an
/// extended frame, 0x8000 makes a remote one), the length, and so many bytes of data.
canopen::Frame read_frame(FuzzInput& input);

/// A node of the bus that nobody has configured, and that says what the fuzzer wants.
class ForeignNode : public transport::CanListener {
 public:
  explicit ForeignNode(transport::VirtualCanBus& bus) : bus_(bus), port_(bus.add_port(*this)) {}

  void on_can_frame(const canopen::Frame&, HostTime) override {}

  /// False where its queue is full.
  bool send(const canopen::Frame& frame, HostTime now) { return bus_.send(port_, frame, now); }
  /// The next frame that is not its own gets `mask` over its byte `position`, as no check sum would let pass:
  /// another node has sent it so.
  void spoil_next(unsigned position, std::uint8_t mask);

 private:
  transport::VirtualCanBus& bus_;
  int port_;
};

}  // namespace interpolated_motion::fuzz
