#include "interpolated_motion_driver/protocol/cia402/interpolation_data_record.h"

#include "interpolated_motion_driver/protocol/canopen/object.h"

namespace interpolated_motion::cia402 {

std::array<std::uint8_t, 8> pack(const InterpolationDataRecord& record) {
  std::array<std::uint8_t, 8> bytes{};
  canopen::put_le(&bytes[0], record.position);
  canopen::put_le(&bytes[4], record.velocity);
  bytes[7] = record.time;  // in place of the velocity's highest byte
  return bytes;
}

InterpolationDataRecord unpack_record(const std::uint8_t* bytes) {
  InterpolationDataRecord record;
  record.position = canopen::get_le<std::int32_t>(bytes);
  record.velocity = static_cast<std::int32_t>(
      canopen::sign_extend(canopen::get_le<std::uint32_t>(bytes + 4) & 0xFFFFFFu, 24));
  record.time = bytes[7];
  return record;
}

}  // namespace interpolated_motion::cia402
