#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace interpolated_motion::simulation {

/// Hash of everything that happens in a simulation (FNV-1a, 64 bit): two runs with the same hash were the
/// same to the last bit. What a person can read besides goes to a listener, where there is one.
class Trace {
 public:
  /// A line, with the time on the script's clock in s.
  using Listener = std::function<void(double time, const std::string& line)>;

  explicit Trace(Listener listener = {}) : listener_(std::move(listener)) {}

  void add(std::uint64_t word) {
    constexpr std::uint64_t kPrime = 0x100000001B3;
    for (int i = 0; i < 8; ++i, word >>= 8) hash_ = (hash_ ^ (word & 0xFF)) * kPrime;
  }
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  void say(double time, const std::string& line) {
    add(time);
    for (const char c : line) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    if (listener_) listener_(time, line);
  }

  std::uint64_t hash() const { return hash_; }

 private:
  Listener listener_;
  std::uint64_t hash_ = 0xCBF29CE484222325;
};

}  // namespace interpolated_motion::simulation
