#pragma once

#include <stdexcept>
#include <string>

namespace interpolated_motion::fuzz {

/// What a fuzzer requires does not hold. Nobody catches it: it ends a fuzzer as a crash, and fails a test.
class Violation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void require(bool condition, const std::string& what) {
  if (!condition) throw Violation(what);
}

}  // namespace interpolated_motion::fuzz
