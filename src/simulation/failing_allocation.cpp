#include "simulation/failing_allocation.h"

#include <execinfo.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

std::uint64_t count = 0;
std::uint64_t freed = 0;
std::uint64_t failing = 0;  ///< number of the allocation that is to fail; 0: none
bool failed = false;

/// Whether the driver asks, as the names of the functions tell that are under way.
bool is_of_the_driver() {
  constexpr int kDepth = 100;
  std::array<void*, kDepth> addresses{};
  const int depth = backtrace(addresses.data(), kDepth);
  char** names = backtrace_symbols(addresses.data(), depth);
  if (names == nullptr) return false;
  bool in_driver = false;
  bool in_emulation = false;
  for (int i = 0; i < depth; ++i) {
    in_driver = in_driver || std::strstr(names[i], "MotionHardware") != nullptr;
    for (const char* outside : {"9emulation", "VirtualCanBus", "VirtualSerialLine"})
      in_emulation = in_emulation || std::strstr(names[i], outside) != nullptr;
  }
  std::free(static_cast<void*>(names));
  return in_driver && !in_emulation;
}

}  // namespace

void* operator new(std::size_t size) {
  if (++count == failing && is_of_the_driver()) {
    failed = true;
    ++freed;
    throw std::bad_alloc();
  }
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  if (memory != nullptr) ++freed;
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

namespace interpolated_motion::simulation {

FailingAllocation::FailingAllocation(std::uint64_t n) {
  std::array<void*, 1> address{};
  backtrace(address.data(), 1);  // it loads a library when it is called first
  failed = false;
  failing = count + n;
}

FailingAllocation::~FailingAllocation() { failing = 0; }

bool FailingAllocation::has_failed() const { return failed; }

std::uint64_t allocations() { return count; }

std::int64_t allocations_held() { return static_cast<std::int64_t>(count - freed); }

}  // namespace interpolated_motion::simulation
