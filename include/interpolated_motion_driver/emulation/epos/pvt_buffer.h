#pragma once

#include <array>
#include <cstdint>

namespace interpolated_motion::emulation {

/// An interpolation data record as it arrives in object 0x20C1 ("EPOS3 Interpolated Position Mode", table
/// 4-24): position in the low 32 bits, velocity in the next 24, time in the top 8, the first two signed.
struct BufferedRecord {
  std::int32_t position = 0;  ///< qc
  std::int32_t velocity = 0;  ///< velocity units (0x608B)
  std::uint8_t time = 0;      ///< ms, 0 ends the mode

  /// The 64 bits as they were written, bit 0 that of the first byte on the wire. Any value is a record.
  static BufferedRecord from_raw(std::uint64_t raw);
};

/// The circular buffer of 64 records (4.3.1.2).
class PvtBuffer {
 public:
  static constexpr int kCapacity = 64;  ///< records, 0x60C4:1

  /// Records, 0..kCapacity.
  int size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == kCapacity; }

  /// Whether a record with time 0 is queued.
  bool terminated() const { return terminators_ > 0; }

  /// The oldest record; not when empty.
  const BufferedRecord& front() const { return records_[head_]; }

  /// Behind the newest; not when full. pop() takes the oldest; not when empty.
  void push(const BufferedRecord& record);
  void pop();
  void clear();

 private:
  std::array<BufferedRecord, kCapacity> records_{};
  std::size_t head_ = 0;
  int size_ = 0;
  int terminators_ = 0;
};

}  // namespace interpolated_motion::emulation
