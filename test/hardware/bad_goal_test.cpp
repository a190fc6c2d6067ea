#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hardware/scenario.h"

namespace interpolated_motion::test {
namespace {

using motion::GroupState;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct BadGoal {
  const char* name;
  std::function<void(trajectory::Goal&)> spoil;
  GoalError code;
  const char* text;  ///< part of what the user reads
};

/// Two joints, from 0 over 0.2 to 0.4 rad.
trajectory::Goal good_goal() {
  return make_goal({0.0, 1.0, 2.0}, {{0.0, 0.0}, {0.2, -0.2}, {0.4, -0.4}},
                   {{0.0, 0.0}, {0.3, -0.3}, {0.0, 0.0}});
}

const BadGoal kBadGoals[] = {
    {"NanPosition", [](auto& g) { g.points[1].positions[1] = kNan; }, GoalError::InvalidGoal, "joint2"},
    {"InfinitePosition", [](auto& g) { g.points[2].positions[0] = kInfinity; }, GoalError::InvalidGoal,
     "joint1"},
    {"NanVelocity", [](auto& g) { g.points[1].velocities[0] = kNan; }, GoalError::InvalidGoal, "joint1"},
    {"NanAcceleration",
     [](auto& g) {
       g.points[1].accelerations = {0.0, kNan};
     },
     GoalError::InvalidGoal, "joint2"},
    {"InfiniteEffort",
     [](auto& g) {
       g.points[1].efforts = {0.0, kInfinity};
     },
     GoalError::InvalidGoal, "joint2"},
    {"NanTime", [](auto& g) { g.points[1].time = GoalTime{kNan}; }, GoalError::InvalidGoal, "points[1]"},
    {"NanTolerance",
     [](auto& g) {
       g.path_tolerance = {{"joint1", kNan, 0, 0}};
     },
     GoalError::InvalidGoal, "joint1"},
    {"HugePathTolerance",
     [](auto& g) {
       g.path_tolerance = {{"joint2", 0, 1e300, 0}};
     },
     GoalError::InvalidGoal, "joint 'joint2' is 1e+300"},
    {"HugeGoalTolerance",
     [](auto& g) {
       g.goal_tolerance = {{"joint1", 1e300, 0, 0}};
     },
     GoalError::InvalidGoal, "joint 'joint1' is 1e+300"},
    {"HugeGoalTime", [](auto& g) { g.goal_time_tolerance = 1e300; }, GoalError::InvalidGoal,
     "goal_time_tolerance is 1e+300 s"},
    {"GoalTimeBeyondThatOfTheParameter", [](auto& g) { g.goal_time_tolerance = 1.1e6; },
     GoalError::InvalidGoal, "goal_time_tolerance is 1100000 s"},
    {"UnknownJoint", [](auto& g) { g.joint_names[1] = "elbow"; }, GoalError::InvalidJoints, "elbow"},
    {"DuplicateJoint", [](auto& g) { g.joint_names[1] = "joint1"; }, GoalError::InvalidJoints, "joint1"},
    {"MissingJoint",
     [](auto& g) {
       g.joint_names.pop_back();
       for (auto& point : g.points) {
         point.positions.pop_back();
         point.velocities.pop_back();
       }
     },
     GoalError::InvalidJoints, "joint2"},
    {"NoJoints", [](auto& g) { g.joint_names.clear(); }, GoalError::InvalidJoints, "joint"},
    {"ShortPositions", [](auto& g) { g.points[1].positions.pop_back(); }, GoalError::InvalidGoal,
     "Size mismatch"},
    {"LongVelocities", [](auto& g) { g.points[1].velocities.push_back(0.0); }, GoalError::InvalidGoal,
     "Size mismatch"},
    {"NoPositions", [](auto& g) { g.points[1].positions.clear(); }, GoalError::InvalidGoal, "Size mismatch"},
    {"EqualTimes", [](auto& g) { g.points[2].time = g.points[1].time; }, GoalError::InvalidGoal,
     "not strictly increasing in time"},
    {"FallingTimes", [](auto& g) { g.points[2].time = GoalTime{0.5}; }, GoalError::InvalidGoal,
     "not strictly increasing in time"},
    {"NegativeTime", [](auto& g) { g.points[0].time = GoalTime{-1.0}; }, GoalError::InvalidGoal, "points[0]"},
    {"PastStamp", [](auto& g) { g.start = HostTime{} - std::chrono::seconds(100); }, GoalError::InvalidGoal,
     "Dropping all 3 trajectory point(s), as they occur before the current time."},
    {"StampAtTheBeginOfTime", [](auto& g) { g.start = HostTime::min(); }, GoalError::InvalidGoal,
     "Last point is 92233720"},
    {"StampAtTheEndOfTime", [](auto& g) { g.start = HostTime::max(); }, GoalError::InvalidGoal,
     "max_start_ahead"},
    {"StampThirtyYearsAhead", [](auto& g) { g.start = HostTime{} + std::chrono::hours(30 * 8766); },
     GoalError::InvalidGoal, "at most 3600 s ahead"},
    {"StartTooFar", [](auto& g) { g.points[0].positions[1] = 0.3; }, GoalError::InvalidGoal, "joint2"},
    {"PositionBetweenKnots",
     [](auto& g) {
       g.points[1].positions[0] = 3.05;
       g.points[1].velocities[0] = 3.0;
       g.points[1].time = GoalTime{3.0};
       g.points[2].positions[0] = 3.05;
       g.points[2].time = GoalTime{4.0};
     },
     GoalError::InvalidGoal, "joint1: the position"},
    {"VelocityBetweenKnots", [](auto& g) { g.points[1].positions[0] = 2.9; }, GoalError::InvalidGoal,
     "joint1: the velocity"},
    {"Acceleration", [](auto& g) { g.points[1].time = GoalTime{0.2}; }, GoalError::InvalidGoal,
     "joint1: the acceleration"},
    {"EndsInMotion", [](auto& g) { g.points[2].velocities[1] = 0.2; }, GoalError::InvalidGoal, "joint2"},
    {"ToleranceOfUnknownJoint",
     [](auto& g) {
       g.goal_tolerance = {{"wrist", 0.1, 0, 0}};
     },
     GoalError::InvalidJoints, "wrist"},
};

class Refused : public ::testing::TestWithParam<BadGoal> {};

TEST_P(Refused, WithCodeAndReasonAndNothingMoves) {
  Scenario scenario(arm_of(2));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle));
  auto goal = good_goal();
  GetParam().spoil(goal);
  const auto answer = scenario.submit(goal);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, GetParam().code) << answer.error().text;
  EXPECT_NE(answer.error().text.find(GetParam().text), std::string::npos) << answer.error().text;
  scenario.run(0.5);
  EXPECT_EQ(scenario.positions(), (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(scenario.snapshot().joints[0].records_sent, 0u);
  const auto good = scenario.submit(good_goal());
  ASSERT_TRUE(good) << good.error().text;
  EXPECT_EQ(scenario.result_of(good.value().id).outcome, motion::GoalOutcome::Succeeded);
}

INSTANTIATE_TEST_SUITE_P(Goals, Refused, ::testing::ValuesIn(kBadGoals),
                         [](const ::testing::TestParamInfo<BadGoal>& goal) { return goal.param.name; });

// 20 kbit/s carry 89 records a second at most; a path that shakes needs more of them.
TEST(BusBudgetOfAGoal, MoreThanTheBusCanCarryIsRefusedWithTheFigure) {
  Scenario scenario(arm_of(2, "{buses: {can0: {bitrate: 20000, sync_period: 0.1, max_load: 0.3}}}"));
  ASSERT_TRUE(scenario.run_until_state(GroupState::Idle, 30.0)) << scenario.snapshot().fault;
  std::vector<double> times;
  std::vector<std::vector<double>> positions;
  for (int i = 0; i <= 1000; ++i) {
    times.push_back(0.02 * i);
    const double shake = i == 0 || i == 1000 ? 0.0 : 0.0006 * std::sin(2.0 * i);
    positions.push_back({shake, -shake});
  }
  const auto answer = scenario.submit(make_goal(times, positions));
  ASSERT_FALSE(answer);
  EXPECT_NE(answer.error().text.find("Bus can0 cannot carry"), std::string::npos) << answer.error().text;
}

}  // namespace
}  // namespace interpolated_motion::test
