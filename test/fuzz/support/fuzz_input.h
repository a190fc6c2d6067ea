#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace interpolated_motion::fuzz {

/// A fuzzer's input, read from its front. What is behind its end are zeros.
class FuzzInput {
 public:
  FuzzInput(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  bool empty() const { return next_ == end_; }

  std::uint8_t byte() { return empty() ? std::uint8_t{0} : *next_++; }
  std::uint16_t word() { return static_cast<std::uint16_t>(byte() | byte() << 8); }  ///< little-endian
  unsigned below(unsigned count) { return byte() % count; }                          ///< `count` 1..256

  /// A number as people send them, and as nobody should. The first byte says of which sort it is: a small one
  /// in thousandths, any bit pattern, or one of those that mean trouble.
  double number();
  /// Up to `count` of them: the first byte says how many.
  std::vector<double> numbers(unsigned count);
  /// `size` bytes, fewer at the end.
  std::string text(std::size_t size);
  /// The text up to the next line feed, which is left out; at most `longest` bytes.
  std::string line(std::size_t longest);
  /// All that is left.
  std::string rest() { return text(static_cast<std::size_t>(end_ - next_)); }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

}  // namespace interpolated_motion::fuzz
