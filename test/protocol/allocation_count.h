#pragma once

#include <cstddef>

namespace interpolated_motion::test {

/// Allocations of the whole test program so far.
std::size_t allocation_count();

}  // namespace interpolated_motion::test
