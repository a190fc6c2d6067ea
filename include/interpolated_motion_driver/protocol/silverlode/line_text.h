#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace interpolated_motion::silverlode {

/// Up to 64 characters of a line, kept without allocation. What does not fit is dropped, `complete` tells.
class LineText {
 public:
  static constexpr std::size_t kCapacity = 64;

  LineText() = default;
  explicit LineText(std::string_view text) {
    for (const char c : text) append(c);
  }

  void append(char c) {
    if (size_ == kCapacity) {
      complete_ = false;
      return;
    }
    characters_[size_++] = c;
  }
  void clear() {
    size_ = 0;
    complete_ = true;
  }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  bool complete() const { return complete_; }
  std::string_view view() const { return {characters_.data(), size_}; }

  /// For messages: without CR and LF at the end, unprintable characters as \xHH, "..." when not complete.
  std::string printable() const;

 private:
  std::array<char, kCapacity> characters_{};
  std::uint8_t size_ = 0;
  bool complete_ = true;
};

}  // namespace interpolated_motion::silverlode
