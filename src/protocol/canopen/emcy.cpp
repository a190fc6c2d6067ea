#include "interpolated_motion_driver/protocol/canopen/emcy.h"

#include <algorithm>

#include "interpolated_motion_driver/protocol/canopen/object.h"

namespace interpolated_motion::canopen {

std::optional<Emcy> decode_emcy(const Frame& frame, HostTime time) {
  if (frame.remote || frame.length < 2) return std::nullopt;
  std::array<std::uint8_t, 8> bytes{};
  const auto length = std::min<std::ptrdiff_t>(frame.length, 8);
  std::copy_n(frame.data.begin(), length, bytes.begin());
  Emcy emcy;
  emcy.code = get_le<std::uint16_t>(bytes.data());
  emcy.error_register = bytes[2];
  std::copy(bytes.begin() + 3, bytes.end(), emcy.manufacturer.begin());
  emcy.complete = length == 8;
  emcy.time = time;
  return emcy;
}

}  // namespace interpolated_motion::canopen
