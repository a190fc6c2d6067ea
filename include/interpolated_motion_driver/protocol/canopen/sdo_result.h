#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "interpolated_motion_driver/protocol/canopen/frame.h"
#include "interpolated_motion_driver/protocol/canopen/object.h"

namespace interpolated_motion::canopen {

/// The bytes of an object. Up to 8 bytes, all that a drive has but texts and recordings, are kept without
/// allocation.
class SdoData {
 public:
  /// The bytes in the order of the wire; `i` < size().
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const std::uint8_t* data() const { return is_small() ? small_.data() : large_.data(); }
  std::uint8_t operator[](std::size_t i) const { return data()[i]; }

  /// Drops all bytes, and adds `count` behind the last. More than 8 in all are allocated.
  void clear();
  void append(const std::uint8_t* bytes, std::size_t count);
  /// Keeps the first `count` bytes; nothing happens when there are no more than that.
  void truncate(std::size_t count);

 private:
  bool is_small() const { return large_.empty(); }

  std::array<std::uint8_t, 8> small_{};
  std::vector<std::uint8_t> large_;
  std::size_t size_ = 0;
};

enum class SdoDirection {
  Upload,    ///< read: drive to host
  Download,  ///< write: host to drive
};

/// Outcome of one SDO transfer.
struct SdoResult {
  std::uint8_t node = 0;                          ///< 1..127
  ObjectAddress address;                          ///< that was asked for
  SdoDirection direction = SdoDirection::Upload;  ///< decides what `data` is
  bool ok = false;                                ///< the drive has confirmed the whole transfer
  std::uint32_t abort_code = 0;                   ///< 0 when `ok`
  bool aborted_by_drive = false;                  ///< the drive sent the abort; else this host did
  SdoData data;                                   ///< what was read, or what was to be written
  HostDuration timeout{};                         ///< for each answer
  Frame last_sent;  ///< the last frame of the transfer before it ended, for the error text

  /// The object as a number: its bytes, least significant first. Bytes that were not received count as zero,
  /// bytes beyond the type's size are ignored; 0 when not `ok`. `as_i32` and `as_i64` extend the sign from
  /// the size received, so an INTEGER16 of -1 reads -1. (An expedited reply without a size is 4 bytes long:
  /// use the narrow one there.)
  std::uint8_t as_u8() const { return static_cast<std::uint8_t>(as_u64()); }
  std::uint16_t as_u16() const { return static_cast<std::uint16_t>(as_u64()); }
  std::uint32_t as_u32() const { return static_cast<std::uint32_t>(as_u64()); }
  std::uint64_t as_u64() const;
  std::int8_t as_i8() const { return static_cast<std::int8_t>(as_u64()); }
  std::int16_t as_i16() const { return static_cast<std::int16_t>(as_u64()); }
  std::int32_t as_i32() const { return static_cast<std::int32_t>(as_i64()); }
  std::int64_t as_i64() const;

  /// A VISIBLE_STRING up to its first zero; unprintable bytes become '?'.
  std::string as_text() const;

  /// One line for the user, with the last frame sent as candump writes it:
  /// "node 3: read of 0x6041:00 = 0x0737",
  /// "node 3: write of 0x6060:00 = 0x07 failed: abort 0x08000022 data cannot be stored because of the present
  /// device state (sent by the drive; last sent to it: 603#2F60600007000000)".
  std::string text() const;
};

}  // namespace interpolated_motion::canopen
