#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "hardware/fault_in_motion.h"

// A fault that the host finds ends a goal only when the drive stands, or can no longer be moving.
namespace interpolated_motion::test {
namespace {

using motion::GoalOutcome;
using motion::GroupState;

/// The drive of joint2 on line0, in hexadecimal as it answers.
constexpr const char* kIoAnswer = "# 11 0015 ";
constexpr unsigned kTrajectoryActive = 1U << 3;
/// Longest motion in the drive's queue (`commit_horizon`) and a segment more, s, and 3.5 rad/s on the ramp of
/// register 19, 20 rad/s^2.
constexpr double kQueue = 2.0 + 0.5;
constexpr double kRamp = 1.2 * 3.5 / 20.0;
/// Four attempts of a command without an answer take the line for about so long, s.
constexpr double kAttempts = 0.3;

/// Sees in the drive's own words whether its trajectory generator is active.
class GeneratorWatch {
 public:
  explicit GeneratorWatch(Scenario& scenario) : scenario_(scenario) {
    scenario.driver().set_wire_observer(
        {{}, [this](const std::string&, const hardware::SerialText& line) { take(line); }});
  }
  ~GeneratorWatch() { scenario_.driver().set_wire_observer({}); }
  GeneratorWatch(const GeneratorWatch&) = delete;
  GeneratorWatch& operator=(const GeneratorWatch&) = delete;

  int looks() const { return looks_; }
  /// In the first answer.
  bool was_active() const { return was_active_; }

 private:
  void take(const hardware::SerialText& line) {
    const std::string text(line.text);
    const std::string head(kIoAnswer);
    if (line.from_host || text.compare(0, head.size(), head) != 0) return;
    if (looks_++ == 0)
      was_active_ = (std::stoul(text.substr(head.size()), nullptr, 16) & kTrajectoryActive) != 0;
  }

  Scenario& scenario_;
  int looks_ = 0;
  bool was_active_ = false;
};

class SilverlodeStandstill : public FaultInMotion {
 protected:
  /// In the middle of a long way, at about 1.5 rad/s.
  void SetUp() override {
    scenario = std::make_unique<Scenario>(six_axis_silverlode());
    ASSERT_TRUE(scenario->run_until_state(GroupState::Idle)) << scenario->snapshot().fault;
    const auto accepted = scenario->submit(make_goal({3.0}, {{2.5, 2.5, 2.5, 2.5, 2.5, 2.5}}));
    ASSERT_TRUE(accepted) << accepted.error().text;
    goal = accepted.value().id;
    ASSERT_TRUE(scenario->run_until_state(GroupState::Moving));
    scenario->run(1.0);
  }

  bool goal_has_ended() { return scenario->snapshot().active_goal != goal; }

  /// The drive refuses segments until the host takes that for a fault.
  void let_the_host_find_a_fault() {
    inject("joint2", "nak 25 5 1000000");
    ASSERT_TRUE(scenario->run_until_state(GroupState::Stopping, 3.0));
  }

  /// The drive is heard and asked again: the first thing it tells about its generator is that it rests.
  void expect_that_it_stands() {
    GeneratorWatch watch(*scenario);
    scenario->driver().reset_faults(scenario->now());
    ASSERT_TRUE(scenario->run_until([&] { return watch.looks() > 0; }, 1.0));
    EXPECT_FALSE(watch.was_active()) << "the drive was still moving when the goal had ended";
  }
};

TEST_F(SilverlodeStandstill, AFaultFoundByTheHostWaitsForIt) {
  let_the_host_find_a_fault();
  ASSERT_FALSE(goal_has_ended()) << "STP is not even on the line yet";
  GeneratorWatch watch(*scenario);
  const auto result = scenario->result_of(goal, 1.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_TRUE(contains(result.text, "Joint joint2 (line0 address 17)")) << result.text;
  EXPECT_GT(watch.looks(), 1) << "one look while it braked, one when it stood";
  EXPECT_TRUE(watch.was_active());
  EXPECT_EQ(scenario->state(), GroupState::Fault);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "The drive has come to rest."))
      << scenario->snapshot().fault;
  expect_that_it_stands();
}

// The drive hears none of four STP, and goes on with its queue meanwhile. It is told again.
TEST_F(SilverlodeStandstill, StpLostFourTimesIsSentAgain) {
  let_the_host_find_a_fault();
  inject("joint2", "silence 1");
  scenario->run(2.0 * kAttempts);
  EXPECT_FALSE(goal_has_ended());
  EXPECT_EQ(scenario->state(), GroupState::Stopping);
  inject("joint2", "silence 0");
  const HostTime heard_again = scenario->now();
  const auto result = scenario->result_of(goal, 3.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_LE(seconds(scenario->now() - heard_again), kAttempts + 2.0 * kRamp);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "The drive has come to rest."))
      << scenario->snapshot().fault;
  inject("joint2", "nak 25 5 0");
  expect_that_it_stands();
  expect_recovery();
}

// Nobody can tell it anything: the group waits for as long as its queue can last and its ramp.
TEST_F(SilverlodeStandstill, ADriveThatHearsNothingIsWaitedFor) {
  inject("joint2", "silence 1");
  ASSERT_TRUE(scenario->run_until_state(GroupState::Stopping, 3.0));
  const HostTime found = scenario->now();
  const auto result = scenario->result_of(goal, 10.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Aborted);
  EXPECT_GE(seconds(scenario->now() - found), kRamp);
  EXPECT_LE(seconds(scenario->now() - found), kQueue + kRamp + kAttempts);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "has not been seen at rest"))
      << scenario->snapshot().fault;
  inject("joint2", "silence 0");
  expect_that_it_stands();
}

// The same of a stop that somebody asked for.
TEST_F(SilverlodeStandstill, AHaltThatIsNotHeardIsWaitedFor) {
  scenario->driver().cancel(goal, scenario->now());
  inject("joint2", "silence 1");
  const HostTime stopped = scenario->now();
  const auto result = scenario->result_of(goal, 10.0);
  EXPECT_EQ(result.outcome, GoalOutcome::Preempted);
  EXPECT_LE(seconds(scenario->now() - stopped), kQueue + kRamp + 2.0 * kAttempts);
  EXPECT_EQ(scenario->state(), GroupState::Fault);
  EXPECT_TRUE(contains(scenario->snapshot().fault, "Joint joint2 (line0 address 17)"))
      << scenario->snapshot().fault;
  inject("joint2", "silence 0");
  expect_that_it_stands();
}

}  // namespace
}  // namespace interpolated_motion::test
