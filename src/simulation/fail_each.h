#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "simulation/script.h"
#include "simulation/simulation.h"

namespace interpolated_motion::simulation {

/// One way in which what crosses a bus can fail once.
struct Failure {
  std::string bus;
  std::string command;      ///< of inject, without its number: drop_nth
  std::uint64_t count = 0;  ///< how often it may happen in the run without it
};

/// What came of failing each in turn.
struct FailEachTally {
  std::uint64_t runs = 0;
  std::uint64_t unnoticed = 0;  ///< all goals succeeded that do so without the failure
  std::uint64_t told = 0;       ///< a goal was refused, aborted or stopped
  std::uint64_t violated = 0;
};

/// Kinds of arms there is a whole run for: epos, cyclic, silverlode, mixed.
const std::vector<std::string>& fail_each_kinds();

/// A whole run of an arm of two joints: bring-up, a goal, a goal that is stopped, disabling. Throws
/// std::invalid_argument for an unknown kind.
Script whole_run(const std::string& kind);

/// The ways that the buses of a run can fail: on CAN a frame that reaches nobody, and a send that is refused;
/// on a serial line a request or a reply that reaches nobody, and a send that is refused.
std::vector<Failure> failures_of(const Script& run);

/// The run with the `n`-th of the failure, 1..count, from the driver's start on.
Script with_failure(const Script& run, const Failure& failure, std::uint64_t n);

/// Fails every `stride`-th allocation of the driver in a run, from `first` on, after bring-up was begun;
/// those that are not the driver's are passed over. The host ends with each, but for one that can be done
/// without. Its program must be linked with -rdynamic.
FailEachTally fail_each_allocation(const Script& run, std::uint64_t first, std::uint64_t stride,
                                   const std::function<void(std::uint64_t n, const Outcome&)>& tell);

/// Runs every `stride`-th of the failure, from `first` on. `tell` is called for each run with its number.
FailEachTally fail_each(const Script& run, const Failure& failure, std::uint64_t first, std::uint64_t stride,
                        const std::function<void(std::uint64_t n, const Script&, const Outcome&)>& tell);

}  // namespace interpolated_motion::simulation
