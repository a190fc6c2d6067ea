#include "interpolated_motion_driver/recording/byte_ring.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace interpolated_motion::recording {

static_assert(std::is_trivially_copyable_v<EntryHead>);

ByteRing::ByteRing(std::size_t capacity) : bytes_(std::max(capacity, sizeof(EntryHead))) {}

void ByteRing::push(const EntryHead& head, const void* bytes) {
  const std::size_t size = sizeof head + head.size;
  if (size > bytes_.size()) {
    ++displaced_;
    return;
  }
  for (; bytes_.size() - used_ < size; ++displaced_) pop();
  append(&head, sizeof head);
  append(bytes, head.size);
}

void ByteRing::forget_before(HostTime time) {
  for (; used_ > 0 && oldest().time < time; ++forgotten_) pop();
}

std::vector<std::byte> ByteRing::copy() const {
  std::vector<std::byte> entries(used_);
  if (used_ > 0) read(begin_, entries.data(), used_);
  return entries;
}

void ByteRing::append(const void* bytes, std::size_t size) {
  const std::size_t at = (begin_ + used_) % bytes_.size();
  const std::size_t first = std::min(size, bytes_.size() - at);
  const auto* from = static_cast<const std::byte*>(bytes);
  if (first > 0) std::memcpy(bytes_.data() + at, from, first);
  if (size > first) std::memcpy(bytes_.data(), from + first, size - first);
  used_ += size;
}

void ByteRing::read(std::size_t from, void* bytes, std::size_t size) const {
  const std::size_t first = std::min(size, bytes_.size() - from);
  auto* to = static_cast<std::byte*>(bytes);
  std::memcpy(to, bytes_.data() + from, first);
  if (size > first) std::memcpy(to + first, bytes_.data(), size - first);
}

EntryHead ByteRing::oldest() const {
  EntryHead head;
  read(begin_, &head, sizeof head);
  return head;
}

void ByteRing::pop() {
  const std::size_t size = sizeof(EntryHead) + oldest().size;
  begin_ = (begin_ + size) % bytes_.size();
  used_ -= size;
}

void for_each_entry(const std::vector<std::byte>& entries,
                    const std::function<void(const EntryHead&, const std::byte* bytes)>& visit) {
  for (std::size_t at = 0; at < entries.size();) {
    EntryHead head;
    std::memcpy(&head, entries.data() + at, sizeof head);
    at += sizeof head;
    visit(head, entries.data() + at);
    at += head.size;
  }
}

}  // namespace interpolated_motion::recording
