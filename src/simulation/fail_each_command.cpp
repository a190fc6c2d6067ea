#include "simulation/fail_each_command.h"

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "simulation/fail_each.h"

namespace interpolated_motion::simulation {

namespace {

void tell_row(const std::string& kind, const std::string& what, const FailEachTally& tally) {
  fmt::print("{:<11} {:<20} {:>6} runs: {:>6} unnoticed, {:>6} told, {:>3} violated\n", kind, what,
             tally.runs, tally.unnoticed, tally.told, tally.violated);
  std::fflush(stdout);
}

void tell_violation(const std::string& kind, const std::string& what, const Outcome& outcome) {
  if (!outcome.violation) return;
  fmt::print("{}: {} FAILED: {}: at {:.3f} s: {}\n", kind, what, outcome.violation->invariant,
             outcome.violation->time, outcome.violation->sentence);
}

void add(FailEachTally& sum, const FailEachTally& tally) {
  sum.runs += tally.runs;
  sum.violated += tally.violated;
}

void fail_frames_of(const std::string& kind, const Options& options, FailEachTally& sum) {
  const Script run = whole_run(kind);
  for (const Failure& failure : failures_of(run)) {
    const auto tell = [&](std::uint64_t n, const Script& script, const Outcome& outcome) {
      tell_violation(kind, fmt::format("{} {} {}", failure.bus, failure.command, n), outcome);
      if (outcome.violation) fmt::print("{}\n", to_text(script));
    };
    const FailEachTally tally = fail_each(run, failure, options.start, options.stride, tell);
    tell_row(kind, fmt::format("{} {}", failure.bus, failure.command), tally);
    add(sum, tally);
  }
}

void fail_allocations_of(const std::string& kind, const Options& options, FailEachTally& sum) {
  const auto tell = [&](std::uint64_t n, const Outcome& outcome) {
    tell_violation(kind, fmt::format("allocation {}", n), outcome);
  };
  const FailEachTally tally = fail_each_allocation(whole_run(kind), options.start, options.stride, tell);
  tell_row(kind, "allocation", tally);
  add(sum, tally);
}

}  // namespace

int run_fail_each(const Options& options) {
  FailEachTally sum;
  const auto kinds = options.kind.empty() ? fail_each_kinds() : std::vector<std::string>{options.kind};
  for (const std::string& kind : kinds) {
    if (options.fail_each == "frame") {
      fail_frames_of(kind, options, sum);
    } else {
      fail_allocations_of(kind, options, sum);
    }
  }
  fmt::print("{} passed, {} failed\n", sum.runs - sum.violated, sum.violated);
  return sum.violated == 0 ? 0 : 1;
}

}  // namespace interpolated_motion::simulation
