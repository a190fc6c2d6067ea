#include "interpolated_motion_driver/protocol/canopen/frame_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace interpolated_motion::canopen {

std::string to_string(const Frame& frame) {
  std::string text = frame.extended ? fmt::format("{:08X}#", frame.id) : fmt::format("{:03X}#", frame.id);
  if (frame.remote) return text + "R";
  const std::size_t length = std::min<std::size_t>(frame.length, frame.data.size());
  for (std::size_t i = 0; i < length; ++i) text += fmt::format("{:02X}", frame.data[i]);
  return text;
}

}  // namespace interpolated_motion::canopen
