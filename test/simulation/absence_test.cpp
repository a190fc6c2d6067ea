#include <gtest/gtest.h>

#include "simulation/invariants/limits.h"
#include "simulation/invariants/on_course.h"
#include "simulation/ledger.h"

// What the invariants hold against cyclic drives while and after the host was away, SYNC each 10 ms.
namespace interpolated_motion::simulation {
namespace {

using motion::GroupState;

constexpr char kArm[] =
    "{joints: [elbow], buses: {can0: {type: canopen}}, drives: {elbow: {bus: can0, type: cyclic, node_id: 1, "
    "counts_per_revolution: 2000, gear_ratio: 100, limits: {max_acceleration: 20}}}}";

class WhileTheHostIsAway : public testing::Test {
 protected:
  static HostTime at(double time) { return HostTime{} + host_duration(time); }

  void enter(GroupState state, double time) {
    ledger.enter(state, at(time));
    Look look;
    look.now = at(time);
    on_course.look(look);
  }

  /// A goal from rest, of which the driver says at its end that so many target positions were missing.
  void succeed(std::uint32_t underruns) {
    enter(GroupState::Settling, 2.9);
    GoalEntry goal;
    goal.result = motion::GoalResult{1, motion::GoalOutcome::Succeeded, GoalError::InvalidGoal, ""};
    on_course.goal_ended(goal);
    motion::MotionReport report;
    report.valid = true;
    report.goal = 1;
    report.joints.resize(1);
    report.joints[0].underruns = underruns;
    Look look;
    look.now = at(3.0);
    look.report = &report;
    on_course.look(look);
  }

  /// Whether a step of the demand within 1 ms, at `time`, is held to be beyond the limits.
  bool minds_a_step(double time) {
    Limits limits(ledger);
    for (const double ms : {-2.0, -1.0, 0.0, 1.0})
      limits.sample({at(time + ms * 1e-3), 0, ms > 0.0 ? 0.01 : 0.0});
    return limits.violation().has_value();
  }

  Ledger ledger{read_arm(kArm)};
  OnCourse on_course{ledger};
};

TEST_F(WhileTheHostIsAway, OneTargetPositionMayBeMissingForEachSync) {
  enter(GroupState::Idle, 0.5);
  ledger.add_absence(at(0.6), at(0.604));
  enter(GroupState::Idle, 0.9);
  enter(GroupState::Preparing, 1.0);
  enter(GroupState::Moving, 1.1);
  ledger.add_absence(at(1.2), at(1.204));
  ledger.add_absence(at(1.4), at(1.404));
  succeed(2);
  EXPECT_FALSE(on_course.violation());
  succeed(3);
  EXPECT_TRUE(on_course.violation());
}

TEST_F(WhileTheHostIsAway, NoneMayBeMissingWithoutThat) {
  enter(GroupState::Idle, 0.5);
  ledger.add_absence(at(0.6), at(0.604));
  enter(GroupState::Idle, 0.9);
  enter(GroupState::Preparing, 1.0);
  succeed(1);
  EXPECT_TRUE(on_course.violation());
}

// Targets go on for a period at least after the host was there last; two periods after it is there again the
// drive is led.
TEST_F(WhileTheHostIsAway, LongADriveIsLeftToItself) {
  enter(GroupState::Moving, 0.5);
  ledger.add_absence(at(1.0), at(1.1));
  EXPECT_TRUE(minds_a_step(1.005));
  EXPECT_FALSE(minds_a_step(1.05));
  EXPECT_FALSE(minds_a_step(1.115));
  EXPECT_TRUE(minds_a_step(1.13));
}

TEST_F(WhileTheHostIsAway, NoLongerThanPromisedADriveKeepsItsLimits) {
  enter(GroupState::Moving, 0.5);
  ledger.add_absence(at(1.0), at(1.004));
  for (const double time : {1.003, 1.012, 1.02}) EXPECT_TRUE(minds_a_step(time)) << time;
}

}  // namespace
}  // namespace interpolated_motion::simulation
