#pragma once

#include <cstdint>
#include <cstdlib>
#include <random>

namespace interpolated_motion::test {

/// Cases of a property test: the environment variable IMD_PROPERTY_CASES, or a number that keeps the test
/// short.
inline int property_cases(int otherwise) {
  const char* text = std::getenv("IMD_PROPERTY_CASES");
  return text != nullptr ? std::atoi(text) : otherwise;
}

/// Uniform in 0..bound-1, the same with every standard library (the bias of the modulo does not matter here).
inline std::uint32_t below(std::mt19937_64& random, std::uint32_t bound) {
  return static_cast<std::uint32_t>((random() >> 16) % bound);
}

}  // namespace interpolated_motion::test
