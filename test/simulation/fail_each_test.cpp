#include "simulation/fail_each.h"

#include <string>

#include <gtest/gtest.h>

namespace interpolated_motion::simulation {
namespace {

/// So many runs of each kind and failure; all of them are `simulate --fail-each frame`.
constexpr std::uint64_t kRuns = 12;

/// A prime, so that it keeps no step with anything.
constexpr std::uint64_t kAllocationStride = 101;

class EachFails : public testing::TestWithParam<std::string> {};

TEST_P(EachFails, TheRunWithoutAFailureSucceeds) {
  const Outcome outcome = simulate(whole_run(GetParam()));
  EXPECT_FALSE(outcome.violation) << outcome.violation->sentence;
  EXPECT_EQ(outcome.goals_succeeded, 2U) << "the first goal, and the stop";
  EXPECT_EQ(outcome.goals_refused, 0U);
}

TEST_P(EachFails, MotionIsRightOrStopsAsItShould) {
  const Script run = whole_run(GetParam());
  for (const Failure& failure : failures_of(run)) {
    ASSERT_GT(failure.count, kRuns) << failure.command;
    const auto tell = [&failure](std::uint64_t n, const Script&, const Outcome& outcome) {
      if (!outcome.violation) return;
      ADD_FAILURE() << failure.bus << " " << failure.command << " " << n << ": "
                    << outcome.violation->invariant << ": at " << outcome.violation->time
                    << " s: " << outcome.violation->sentence;
    };
    // Odd, so that it does not keep step with what each SYNC brings.
    const std::uint64_t stride = failure.count / kRuns | 1U;
    const FailEachTally tally = fail_each(run, failure, 1, stride, tell);
    EXPECT_GE(tally.runs, kRuns - 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EachFails, testing::ValuesIn(fail_each_kinds()),
                         [](const auto& kind) { return kind.param; });

TEST_P(EachFails, AnAllocationThatFailsEndsTheHostAndTheDrivesStop) {
  const Script run = whole_run(GetParam());
  const auto tell = [](std::uint64_t n, const Outcome& outcome) {
    if (!outcome.violation) return;
    ADD_FAILURE() << "allocation " << n << ": " << outcome.violation->invariant << ": at "
                  << outcome.violation->time << " s: " << outcome.violation->sentence;
  };
  const FailEachTally tally = fail_each_allocation(run, 1, kAllocationStride, tell);
  EXPECT_GT(tally.told, 0U);
}

// Each failure happens, and once: the frame is missing on the bus.
TEST(Failure, IsThatOfTheNthFrame) {
  const Script run = whole_run("epos");
  const Outcome without = simulate(run);
  for (const std::uint64_t n : {1U, 7U, 400U}) {
    const Outcome with = simulate(with_failure(run, {"can0", "drop_nth", 1000}, n));
    EXPECT_NE(with.trace, without.trace) << n;
  }
}

}  // namespace
}  // namespace interpolated_motion::simulation
