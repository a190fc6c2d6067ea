#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "interpolated_motion_driver/units/time.h"

namespace interpolated_motion::recording {

enum class EntryKind : std::uint8_t { Frame, Line, Setpoint, Joint, Note };

/// What stands before the bytes of an entry. What `source`, `flags` and `detail` mean, the kind says.
struct EntryHead {
  HostTime time{};
  std::uint32_t size = 0;  ///< bytes of the entry behind its head
  EntryKind kind = EntryKind::Note;
  std::uint8_t source = 0;
  std::uint8_t flags = 0;
  std::uint8_t detail = 0;
};

/// The newest entries, in memory that is taken once. Nothing is allocated afterwards but by copy().
class ByteRing {
 public:
  /// `capacity` in bytes, heads included; at least that of a head.
  explicit ByteRing(std::size_t capacity);

  /// Adds an entry of `head.size` bytes; the oldest make room for it. One that is larger than the whole ring
  /// is left out.
  void push(const EntryHead& head, const void* bytes);
  /// Forgets entries from the oldest one on, up to the first that is not older than `time`.
  void forget_before(HostTime time);

  std::size_t capacity() const { return bytes_.size(); }
  std::size_t used() const { return used_; }  ///< bytes
  /// Entries that are no longer there because they were too old, and because there was no room.
  std::uint64_t forgotten() const { return forgotten_; }
  std::uint64_t displaced() const { return displaced_; }

  /// All entries, oldest first, for for_each_entry().
  std::vector<std::byte> copy() const;

 private:
  void append(const void* bytes, std::size_t size);
  void read(std::size_t from, void* bytes, std::size_t size) const;
  EntryHead oldest() const;
  void pop();

  std::vector<std::byte> bytes_;
  std::size_t begin_ = 0;  ///< of the oldest entry
  std::size_t used_ = 0;
  std::uint64_t forgotten_ = 0;
  std::uint64_t displaced_ = 0;
};

/// Calls `visit` for each entry of ByteRing::copy().
void for_each_entry(const std::vector<std::byte>& entries,
                    const std::function<void(const EntryHead&, const std::byte* bytes)>& visit);

}  // namespace interpolated_motion::recording
