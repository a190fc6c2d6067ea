#include "interpolated_motion_driver/protocol/canopen/crc16.h"

namespace interpolated_motion::canopen {
namespace {

std::uint16_t add_byte(std::uint16_t crc, std::uint8_t byte) {
  unsigned reg = crc ^ static_cast<unsigned>(byte << 8);
  for (int bit = 0; bit < 8; ++bit) reg = (reg & 0x8000u) != 0 ? reg << 1 ^ 0x1021u : reg << 1;
  return static_cast<std::uint16_t>(reg);
}

}  // namespace

std::uint16_t crc16(const std::uint8_t* data, std::size_t size, std::uint16_t crc) {
  for (std::size_t i = 0; i < size; ++i) crc = add_byte(crc, data[i]);
  return crc;
}

}  // namespace interpolated_motion::canopen
