#include "interpolated_motion_driver/emulation/epos/pvt_buffer.h"

namespace interpolated_motion::emulation {

BufferedRecord BufferedRecord::from_raw(std::uint64_t raw) {
  BufferedRecord record;
  record.position = static_cast<std::int32_t>(static_cast<std::uint32_t>(raw));
  // The velocity's sign bit is moved to the top of 32 bits and back.
  record.velocity = static_cast<std::int32_t>(static_cast<std::uint32_t>(raw >> 24) & 0xFFFFFF00U) / 256;
  record.time = static_cast<std::uint8_t>(raw >> 56);
  return record;
}

void PvtBuffer::push(const BufferedRecord& record) {
  records_[(head_ + static_cast<std::size_t>(size_)) % kCapacity] = record;
  ++size_;
  if (record.time == 0) ++terminators_;
}

void PvtBuffer::pop() {
  if (records_[head_].time == 0) --terminators_;
  head_ = (head_ + 1) % kCapacity;
  --size_;
}

void PvtBuffer::clear() {
  head_ = 0;
  size_ = 0;
  terminators_ = 0;
}

}  // namespace interpolated_motion::emulation
