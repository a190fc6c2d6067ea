#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace interpolated_motion::silverlode {

/// Up to 64 characters of a line, kept without allocation. Those that do not fit are only counted.
class LineText {
 public:
  static constexpr std::size_t kCapacity = 64;  ///< characters that are kept

  LineText() = default;
  /// The first kCapacity characters of `text`.
  explicit LineText(std::string_view text) {
    for (const char c : text) append(c);
  }

  /// Adds one character behind the others, or counts it only.
  void append(char c) {
    if (length_ < kCapacity) characters_[length_] = c;
    ++length_;
  }
  /// Forgets all characters and their count.
  void clear() { length_ = 0; }

  /// Whether nothing has been appended since.
  bool empty() const { return length_ == 0; }
  /// Characters appended, kept or not.
  std::size_t length() const { return length_; }
  /// Whether all characters appended are kept.
  bool complete() const { return length_ <= kCapacity; }
  /// The characters kept.
  std::string_view view() const { return {characters_.data(), complete() ? length_ : kCapacity}; }

  /// For messages: without CR and LF at the end, unprintable characters as \xHH, "..." when not complete.
  std::string printable() const;

 private:
  std::array<char, kCapacity> characters_{};
  std::size_t length_ = 0;
};

}  // namespace interpolated_motion::silverlode
