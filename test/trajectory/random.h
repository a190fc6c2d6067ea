#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace interpolated_motion::trajectory {

/// Seeded numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  /// Uniform in low .. high.
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 engine_;
};

/// Number of random cases: IMD_PROPERTY_CASES, or `standard`.
inline int property_cases(int standard) {
  const char* text = std::getenv("IMD_PROPERTY_CASES");
  return text == nullptr ? standard : std::stoi(text);
}

}  // namespace interpolated_motion::trajectory
