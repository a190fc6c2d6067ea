#pragma once

#include <cstdint>

namespace interpolated_motion::transport {

constexpr int kSerialDataBits = 8;

// Level a talker gives to the line in bit `bit` of its character: start bit, data from the least significant
// bit on, and high before and after.
inline bool line_high(char value, std::int64_t bit) {
  if (bit == 0) return false;
  if (bit < 0 || bit > kSerialDataBits) return true;
  return (static_cast<unsigned char>(value) >> (bit - 1) & 1U) != 0;
}

// What a receiver locked on `first` reads when `second` starts `offset` bit times later (or earlier, if
// negative).
inline char overlay(char first, char second, std::int64_t offset) {
  auto read = static_cast<unsigned char>(first);
  for (int bit = 1; bit <= kSerialDataBits; ++bit) {
    if (!line_high(second, bit - offset)) read = static_cast<unsigned char>(read & ~(1U << (bit - 1)));
  }
  return static_cast<char>(read);
}

}  // namespace interpolated_motion::transport
