#pragma once

#include <cstddef>
#include <cstdint>

namespace interpolated_motion::canopen {

/// CRC of SDO block transfer (CiA 301, 7.2.4.3.16): CRC-16-CCITT, polynomial 0x1021, initial value 0, not
/// reflected, no final inversion. Pass the result as `crc` to go on with more bytes.
std::uint16_t crc16(const std::uint8_t* data, std::size_t size, std::uint16_t crc = 0);

}  // namespace interpolated_motion::canopen
