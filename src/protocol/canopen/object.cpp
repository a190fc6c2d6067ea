#include "interpolated_motion_driver/protocol/canopen/object.h"

#include <fmt/format.h>

namespace interpolated_motion::canopen {

std::string to_string(ObjectAddress address) {
  return fmt::format("0x{:04X}:{:02X}", address.index, address.subindex);
}

}  // namespace interpolated_motion::canopen
