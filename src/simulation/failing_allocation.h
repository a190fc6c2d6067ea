#pragma once

#include <cstdint>

namespace interpolated_motion::simulation {

/// While it lives, the `n`-th allocation by operator new (1: the next one) fails, if the driver asks for it:
/// within a call of hardware::MotionHardware, and not for an emulated bus or drive, which are what is outside
/// of the process in earnest. Otherwise it succeeds. Needs a program whose functions have names (-rdynamic).
class FailingAllocation {
 public:
  explicit FailingAllocation(std::uint64_t n);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;

  /// The allocation has failed.
  bool has_failed() const;
};

/// Allocations so far, and those of them that are not freed.
std::uint64_t allocations();
std::int64_t allocations_held();

}  // namespace interpolated_motion::simulation
