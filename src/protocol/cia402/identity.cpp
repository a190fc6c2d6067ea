#include "interpolated_motion_driver/protocol/cia402/identity.h"

#include <fmt/format.h>

namespace interpolated_motion::cia402 {

std::string describe_identity(const Identity& identity) {
  // Product number of maxon's EDS for the EPOS2 70/10, firmware 0x2126.
  constexpr std::uint16_t kEpos2Hardware = 0x6420;
  if (!identity.is_maxon()) {
    return fmt::format("vendor 0x{:08X}, product 0x{:08X}", identity.vendor, identity.product);
  }
  const std::string firmware = fmt::format("firmware 0x{:04X}", identity.firmware_version());
  if (identity.hardware_version() == kEpos2Hardware) return "maxon EPOS2 70/10, " + firmware;
  return fmt::format("maxon drive, hardware 0x{:04X}, {}", identity.hardware_version(), firmware);
}

}  // namespace interpolated_motion::cia402
