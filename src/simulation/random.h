#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace interpolated_motion::simulation {

/// The one source of chance of a simulation: xoshiro256** (Blackman, Vigna, "Scrambled linear pseudorandom
/// number generators"), its state filled by splitmix64 from a seed. Distributions are its own, so a seed
/// gives the same numbers with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) word = split_mix(seed);
  }

  std::uint64_t next() {
    const std::uint64_t result = rotated(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotated(state_[3], 45);
    return result;
  }

  /// Uniform in [low, high).
  double number(double low, double high) {
    constexpr double kTwoTo53 = 9007199254740992.0;
    return low + (high - low) * static_cast<double>(next() >> 11) / kTwoTo53;
  }
  /// As number(), rounded to thousandths, so that it reads well in a script.
  double thousandths(double low, double high) {
    return static_cast<double>(whole(static_cast<int>(low * 1000.0), static_cast<int>(high * 1000.0))) /
           1000.0;
  }
  /// Uniform in low..high, both included; low <= high.
  int whole(int low, int high) {
    return low + static_cast<int>(next() % (static_cast<std::uint64_t>(high - low) + 1));
  }
  /// True in `share` of all calls, 0..1.
  bool chance(double share) { return number(0.0, 1.0) < share; }
  /// One of `values`, which is not empty.
  template <class Value>
  Value pick(std::initializer_list<Value> values) {
    return values.begin()[next() % values.size()];
  }

 private:
  static std::uint64_t split_mix(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }
  static std::uint64_t rotated(std::uint64_t x, int by) { return (x << by) | (x >> (64 - by)); }

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace interpolated_motion::simulation
