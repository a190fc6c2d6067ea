#pragma once

#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/frame_text.h"
#include "interpolated_motion_driver/protocol/canopen/master.h"

namespace interpolated_motion::canopen::test {

inline constexpr std::uint8_t kData[8] = {1, 2, 3, 4, 5, 6, 7, 8};

/// Frames that may go at `now`, as candump writes them.
inline std::vector<std::string> drain(Master& master, HostTime now, std::size_t most = 1000) {
  std::vector<std::string> sent;
  while (sent.size() < most) {
    const Frame* frame = master.peek_outgoing(now);
    if (frame == nullptr) break;
    sent.push_back(to_string(*frame));
    master.pop_outgoing(now);
  }
  return sent;
}

inline ReceivedFrame from_bus(const Frame& frame, HostTime time, bool own = false) {
  return {frame, time, own};
}

using Texts = std::vector<std::string>;

}  // namespace interpolated_motion::canopen::test
