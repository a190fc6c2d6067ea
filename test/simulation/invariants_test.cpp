#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/invariant.h"
#include "simulation/ledger.h"

// Each invariant must be able to fail: it is shown something that must not be.
namespace interpolated_motion::simulation {
namespace {

using motion::GroupState;

constexpr char kArm[] =
    "{joints: [elbow], drives: {elbow: {bus: can0, counts_per_revolution: 2000, gear_ratio: 100, limits: "
    "{max_acceleration: "
    "20}}}}";

class WrongThing : public testing::Test {
 protected:
  WrongThing() : ledger(read_arm(kArm)), all(all_invariants(ledger)) {
    snapshot.joints.resize(1);
    snapshot.joints[0].capacity = 64;
    positions.assign(1, 0.0);
    powers.assign(1, false);
  }

  static HostTime at(double time) { return HostTime{} + host_duration(time); }

  void sample(double time, double demand) {
    for (const auto& invariant : all) invariant->sample({at(time), 0, demand});
  }

  void look(double time) {
    snapshot.state = ledger.state();
    Look seen;
    seen.now = at(time);
    seen.snapshot = &snapshot;
    seen.positions = &positions;
    seen.powers = &powers;
    seen.is_host_there = is_host_there;
    seen.log_lines = log_lines;
    seen.report = report.valid ? &report : nullptr;
    for (const auto& invariant : all) invariant->look(seen);
  }

  void look_at(double time, double position) {
    positions[0] = position;
    snapshot.joints[0].actual.position = position;
    look(time);
  }

  void enter(GroupState state, double time) {
    ledger.enter(state, at(time));
    snapshot.fault = state == GroupState::Fault ? "why" : "";
    for (const auto& invariant : all) invariant->state_change(at(time));
  }

  void accept(motion::GoalId id, double time) {
    GoalEntry entry;
    entry.accepted = at(time);
    entry.due = at(time + 5.0);
    entry.target = {{0, 1.0}};
    ledger.accept(id, entry);
  }

  void end(motion::GoalId id, motion::GoalOutcome outcome, const std::string& text) {
    if (const auto wrong = ledger.take(motion::GoalResult{id, outcome, GoalError::InvalidGoal, text})) {
      for (const auto& invariant : all) invariant->wrong_answer(*wrong);
      return;
    }
    for (const auto& invariant : all) invariant->goal_ended(ledger.goals().at(id));
  }

  /// Enabled and at rest, by the order of enable_on_start.
  void be_idle() { enter(GroupState::Idle, 0.0); }

  std::set<std::string> violated() const {
    std::set<std::string> names;
    for (const auto& invariant : all)
      if (invariant->violation()) names.insert(invariant->name());
    return names;
  }

  Ledger ledger;
  std::vector<std::unique_ptr<Invariant>> all;
  motion::Snapshot snapshot;
  std::vector<double> positions;
  std::vector<bool> powers;
  motion::MotionReport report;
  std::size_t log_lines = 0;
  bool is_host_there = true;
};

using Names = std::set<std::string>;

TEST_F(WrongThing, NothingIsWrongWithAnArmAtRest) {
  be_idle();
  for (int i = 0; i < 1000; ++i) {
    sample(0.001 * i, 0.5);
    look_at(0.001 * i, 0.5);
  }
  EXPECT_EQ(violated(), Names{});
}

TEST_F(WrongThing, DemandBeyondThePositionLimit) {
  sample(0.0, 3.10005);
  EXPECT_EQ(violated(), Names{});
  sample(1.0, 3.102);
  EXPECT_EQ(violated(), Names{"limits"});
}

TEST_F(WrongThing, DemandTooFast) {
  for (int i = 0; i < 5; ++i) sample(0.001 * i, 3.5e-3 * i);
  EXPECT_EQ(violated(), Names{});
  for (int i = 5; i < 10; ++i) sample(0.001 * i, 4.5e-3 * i);
  EXPECT_EQ(violated(), Names{"limits"});
}

TEST_F(WrongThing, DemandThatJerks) {
  for (int i = 0; i < 5; ++i) sample(0.001 * i, 1e-3 * i);
  for (int i = 5; i < 10; ++i) sample(0.001 * i, 4e-3 + 0.9e-3 * (i - 4));
  EXPECT_EQ(violated(), Names{"limits"});
}

TEST_F(WrongThing, AJointThatBrakesTooHard) {
  enter(GroupState::Stopping, 0.0);
  for (int i = 0; i < 12; ++i) look_at(0.01 * i, 2e-2 * i);
  EXPECT_EQ(violated(), Names{});
  for (int i = 12; i < 22; ++i) look_at(0.01 * i, 22e-2);
  EXPECT_EQ(violated(), Names{"braking"});
}

TEST_F(WrongThing, AJointThatCreepsAtRest) {
  be_idle();
  for (int i = 0; i < 200; ++i) look_at(0.01 * i, 1e-6 * i);
  EXPECT_EQ(violated(), Names{"still without an order"});
}

TEST_F(WrongThing, AGroupThatMovesByItself) {
  be_idle();
  enter(GroupState::Moving, 1.0);
  EXPECT_EQ(violated(), Names{"still without an order"});
}

TEST_F(WrongThing, AFaultThatGoesAwayByItself) {
  enter(GroupState::Fault, 0.0);
  enter(GroupState::Disabled, 1.0);
  EXPECT_EQ(violated(), Names{"a fault holds"});
}

TEST_F(WrongThing, PowerThatComesByItself) {
  enter(GroupState::Fault, 0.0);
  ledger.request(1, "reset", at(0.5));
  enter(GroupState::Disabled, 1.0);
  enter(GroupState::Idle, 2.0);
  EXPECT_EQ(violated(), Names{"a fault holds"});
}

TEST_F(WrongThing, PowerAfterAnAnswerThatItIsOff) {
  ledger.add_fault(at(-0.1), "elbow", "emcy 0x2310");
  enter(GroupState::Fault, 0.0);
  ledger.request(1, "disable", at(0.5));
  powers[0] = true;
  look(0.6);
  EXPECT_EQ(violated(), Names{});
  ledger.take(motion::RequestResult{1, false, "all other drives are disabled"});
  for (const auto& invariant : all) invariant->request_ended(ledger.requests().at(1));
  look(0.7);
  EXPECT_EQ(violated(), Names{"off is off"});
}

TEST_F(WrongThing, PowerOfADriveOutOfReachOrAskedForIsRight) {
  enter(GroupState::Fault, 0.0);
  ledger.add_fault(at(0.2), "elbow", "silence 1");
  ledger.request(1, "disable", at(0.5));
  ledger.take(motion::RequestResult{1, false, "all other drives are disabled"});
  for (const auto& invariant : all) invariant->request_ended(ledger.requests().at(1));
  powers[0] = true;
  look(0.7);
  EXPECT_EQ(violated(), Names{});
}

TEST_F(WrongThing, AJointThatGoesOnWhenTheGroupStops) {
  enter(GroupState::Stopping, 0.0);
  for (int i = 0; i < 100; ++i) look_at(0.01 * i, 0.01 * i);
  EXPECT_EQ(violated(), Names{"stops together"});
}

TEST_F(WrongThing, AJointThatGoesOnWhenTheHostIsDead) {
  be_idle();
  ledger.die(at(0.1));
  enter(GroupState::Moving, 0.1);
  for (int i = 10; i < 1000; ++i) look_at(0.01 * i, 0.01 * i);
  EXPECT_EQ(violated().count("stops together"), 1U);
}

TEST_F(WrongThing, AGoalThatNeverEnds) {
  be_idle();
  accept(1, 0.0);
  enter(GroupState::Moving, 0.1);
  snapshot.active_goal = 1;
  look(4.9);
  EXPECT_EQ(violated(), Names{});
  look(5.1);
  EXPECT_EQ(violated(), Names{"orders end once"});
}

TEST_F(WrongThing, AGoalThatEndsTwice) {
  accept(1, 0.0);
  end(1, motion::GoalOutcome::Succeeded, "");
  EXPECT_EQ(violated(), Names{});
  end(1, motion::GoalOutcome::Succeeded, "");
  EXPECT_EQ(violated(), Names{"orders end once"});
}

TEST_F(WrongThing, AnAnswerToNoQuestion) {
  end(7, motion::GoalOutcome::Succeeded, "");
  EXPECT_EQ(violated(), Names{"orders end once"});
  EXPECT_TRUE(ledger.take(motion::RequestResult{3, true, "done"}));
}

TEST_F(WrongThing, AFailureWithoutACause) {
  ledger.add_fault(at(0.0), "elbow", "stall 1");
  accept(1, 0.0);
  end(1, motion::GoalOutcome::Aborted, "");
  EXPECT_EQ(violated(), Names{"orders end once"});
}

TEST_F(WrongThing, APreemptionNobodyAskedFor) {
  accept(1, 0.0);
  end(1, motion::GoalOutcome::Preempted, "cancelled");
  EXPECT_EQ(violated(), Names{"orders end once"});
}

TEST_F(WrongThing, ARequestThatIsNeverAnswered) {
  be_idle();
  ledger.request(1, "halt", at(0.0));
  look(2.9);
  EXPECT_EQ(violated(), Names{});
  look(3.1);
  EXPECT_EQ(violated(), Names{"orders end once"});
}

TEST_F(WrongThing, AHaltThatIsAnsweredInMotion) {
  accept(1, 0.0);
  enter(GroupState::Moving, 0.1);
  snapshot.active_goal = 1;
  ledger.request(1, "halt", at(0.2));
  ledger.take(motion::RequestResult{1, true, "the group is at rest"});
  for (const auto& invariant : all) invariant->request_ended(ledger.requests().at(1));
  look(0.21);
  EXPECT_EQ(violated(), Names{"orders end once"});
}

TEST_F(WrongThing, AGoalThatCannotBeIsAccepted) {
  for (const auto& invariant : all) invariant->wrongly_accepted("ends in motion");
  EXPECT_EQ(violated(), Names{"refused at once"});
}

TEST_F(WrongThing, AnAcceptedGoalIsAborted) {
  accept(1, 0.0);
  end(1, motion::GoalOutcome::Aborted, "a drive is lost");
  EXPECT_EQ(violated(), Names{"accepted is held"});
}

TEST_F(WrongThing, AbortedAfterAFaultIsRight) {
  accept(1, 0.0);
  ledger.add_fault(at(0.1), "elbow", "stall 1");
  end(1, motion::GoalOutcome::Aborted, "a drive is lost");
  EXPECT_EQ(violated(), Names{});
}

TEST_F(WrongThing, SuccessBesideTheLastPoint) {
  be_idle();
  accept(1, 0.0);
  end(1, motion::GoalOutcome::Succeeded, "");
  look_at(1.0, 0.99);
  EXPECT_EQ(violated(), Names{"accepted is held"});
}

TEST_F(WrongThing, AFaultWithoutOne) {
  enter(GroupState::Fault, 0.0);
  look(0.0);
  EXPECT_EQ(violated(), Names{"accepted is held"});
}

TEST_F(WrongThing, SuccessOffThePath) {
  be_idle();
  accept(1, 0.0);
  end(1, motion::GoalOutcome::Succeeded, "");
  report.valid = true;
  report.goal = 1;
  report.joints.resize(1);
  report.joints[0].worst_deviation = 1.6;
  look_at(1.0, 1.0);
  EXPECT_EQ(violated(), Names{"on course"});
}

TEST_F(WrongThing, APublishedPositionBesideTheTrueOne) {
  be_idle();
  snapshot.joints[0].online = true;
  snapshot.joints[0].actual.position = 1e-3;
  for (int i = 0; i < 300; ++i) look(0.01 * i);
  EXPECT_EQ(violated(), Names{"published is true"});
}

TEST_F(WrongThing, AFaultWithoutText) {
  ledger.add_fault(at(0.0), "elbow", "stall 1");
  enter(GroupState::Fault, 0.0);
  snapshot.fault.clear();
  look(0.1);
  EXPECT_EQ(violated(), Names{"published is true"});
}

TEST_F(WrongThing, MoreRecordsThanTheFifoHolds) {
  be_idle();
  snapshot.joints[0].fill = 65;
  look(0.1);
  EXPECT_EQ(violated(), Names{"published is true"});
}

TEST_F(WrongThing, ADesiredPositionThatJumps) {
  be_idle();
  accept(1, 0.0);
  enter(GroupState::Moving, 0.1);
  snapshot.active_goal = 1;
  look(0.2);
  snapshot.joints[0].desired.position = 0.5;
  look(0.21);
  EXPECT_EQ(violated(), Names{"desired is smooth"});
}

// An order that is carried out when the host comes back, before it has read what has come meanwhile, changes
// what is published of the old positions.
TEST_F(WrongThing, DesiredPositionThatJumpsAfterAnAbsence) {
  constexpr double kBack = 0.5;
  be_idle();
  accept(1, 0.0);
  enter(GroupState::Moving, 0.1);
  snapshot.active_goal = 1;
  look(0.2);
  ledger.add_absence(at(0.2), at(kBack));
  ASSERT_FALSE(ledger.is_disturbed()) << "else nothing is said of jumps";
  is_host_there = false;
  look(0.3);
  is_host_there = true;
  enter(GroupState::Stopping, kBack);
  snapshot.joints[0].desired.position = 1e-5;
  look(kBack);
  snapshot.joints[0].desired.position = 1.0;  // at 3.5 rad/s, in the 0.3 s of absence
  look(kBack + 0.005);
  EXPECT_EQ(violated(), Names{});
  snapshot.joints[0].desired.position = 1.1;
  look(kBack + 0.1);  // by then all reports of the absence have come
  snapshot.joints[0].desired.position = 2.5;
  look(kBack + 0.11);
  EXPECT_EQ(violated(), Names{"desired is smooth"});
}

TEST_F(WrongThing, ALogThatIsFlooded) {
  be_idle();
  log_lines = 30;
  for (int i = 0; i < 10; ++i) look(0.01 * i);
  EXPECT_EQ(violated(), Names{"bounded"});
}

TEST(Invariants, HaveNamesOfTheirOwn) {
  const Ledger ledger(read_arm(kArm));
  Names names;
  const auto all = all_invariants(ledger);
  for (const auto& invariant : all) names.insert(invariant->name());
  EXPECT_EQ(names.size(), all.size());
}

}  // namespace
}  // namespace interpolated_motion::simulation
