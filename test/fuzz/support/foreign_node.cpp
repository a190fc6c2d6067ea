#include "fuzz/support/foreign_node.h"

#include <algorithm>

namespace interpolated_motion::fuzz {
namespace {

constexpr unsigned kStandard = 0x7FF;
constexpr unsigned kExtended = 0x1000;
constexpr unsigned kRemote = 0x8000;

}  // namespace

canopen::Frame read_frame(FuzzInput& input) {
  canopen::Frame frame;
  const unsigned word = input.word();
  frame.id = word & kStandard;
  frame.extended = (word & kExtended) != 0;
  if (frame.extended) frame.id |= static_cast<unsigned>(input.word()) << 11 & 0x1FFFFFFFU;
  frame.remote = (word & kRemote) != 0;
  frame.length = static_cast<std::uint8_t>(input.below(9));
  if (frame.remote) return frame;
  std::generate_n(frame.data.begin(), frame.length, [&input] { return input.byte(); });
  return frame;
}

void ForeignNode::spoil_next(unsigned position, std::uint8_t mask) {
  bus_.tamper([position, mask, left = 1](canopen::Frame& frame) mutable {
    if (left == 0 || frame.remote || frame.length == 0) return;
    --left;
    frame.data.at(position % frame.length) ^= mask;
  });
}

}  // namespace interpolated_motion::fuzz
