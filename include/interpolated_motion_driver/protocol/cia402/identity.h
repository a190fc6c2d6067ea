#pragma once

#include <cstdint>
#include <string>

namespace interpolated_motion::cia402 {

/// As CiA has given it to maxon motor.
inline constexpr std::uint32_t kMaxonVendorId = 0x000000FB;

/// Who a drive says it is, object 0x1018 (CiA 301).
struct Identity {
  std::uint32_t vendor = 0;    ///< as CiA has given it
  std::uint32_t product = 0;   ///< the vendor's; maxon: hardware version << 16
  std::uint32_t revision = 0;  ///< the vendor's; maxon: firmware version << 16
  std::uint32_t serial = 0;    ///< 0 for drives that have none

  /// Whether `vendor` is kMaxonVendorId.
  bool is_maxon() const { return vendor == kMaxonVendorId; }
  /// Of a maxon drive; without meaning for others.
  std::uint16_t hardware_version() const { return static_cast<std::uint16_t>(product >> 16); }
  std::uint16_t firmware_version() const { return static_cast<std::uint16_t>(revision >> 16); }
};

/// "maxon EPOS2 70/10, firmware 0x2126", "maxon drive, hardware 0x6322, firmware 0x2100" for hardware
/// versions not known by name, "vendor 0x0000009A, product 0x00000030" for others. For texts only: whether a
/// drive has mode 7 is told by its objects (0x60C4 and 0x20C1; EPOS4 up to firmware 0x0170 has neither), not
/// by its product code.
std::string describe_identity(const Identity& identity);

}  // namespace interpolated_motion::cia402
