#include "interpolated_motion_driver/trajectory/goal_validation.h"

#include <limits>

#include <gtest/gtest.h>

#include "trajectory/goals.h"

namespace interpolated_motion::trajectory {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const std::vector<std::string> kJoints{"joint1", "joint2"};
const std::string kSizes = "Size mismatch in trajectory point position, velocity or acceleration data.";
const std::string kTimes = "Trajectory message contains waypoints that are not strictly increasing in time.";

Goal good() {
  Goal goal;
  goal.joint_names = {"joint2", "joint1"};
  goal.points = {point(0, {0, 0}, {0, 0}, {0, 0}), point(1, {1, 2}, {0, 0}, {0, 0})};
  return goal;
}

void expect_refused(const Goal& goal, GoalError code, const std::string& start, const std::string& mentions) {
  const auto refusal = validate_goal(goal, kJoints, false);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, code);
  EXPECT_EQ(refusal->text.rfind(start, 0), 0u) << refusal->text;
  EXPECT_NE(refusal->text.find(mentions), std::string::npos) << refusal->text;
}

TEST(GoalValidation, AcceptsAGoodGoalInAnyJointOrder) {
  EXPECT_FALSE(validate_goal(good(), kJoints, false));
  EXPECT_EQ(joint_columns(good().joint_names, kJoints, false).value(), (std::vector<std::size_t>{1, 0}));
}

TEST(GoalValidation, RefusesWrongNames) {
  Goal goal = good();
  goal.joint_names = {"joint1", "joint1"};
  expect_refused(goal, GoalError::InvalidJoints, "", "'joint1' is named twice");
  goal.joint_names = {"joint1", "elbow"};
  expect_refused(goal, GoalError::InvalidJoints, "",
                 "'elbow' is not known here. Known joints: joint1, joint2");
  goal.joint_names = {};
  expect_refused(goal, GoalError::InvalidJoints, "", "names no joints");
  goal.joint_names = {"joint2"};
  expect_refused(goal, GoalError::InvalidJoints, "", "'joint1' is missing");
  goal.joint_names = {"joint1", "joint2", "joint3"};
  expect_refused(goal, GoalError::InvalidJoints, "", "'joint3'");
}

TEST(GoalValidation, AcceptsSomeOfTheJointsWhereAllowed) {
  EXPECT_EQ(joint_columns({"joint2"}, kJoints, true).value(), (std::vector<std::size_t>{kNotNamed, 0}));
  EXPECT_TRUE(joint_columns({}, kJoints, true).has_error());
}

TEST(GoalValidation, ARequestToStopIsWellFormed) {
  Goal goal = good();
  EXPECT_FALSE(is_stop_request(goal));
  goal.points.clear();
  EXPECT_TRUE(is_stop_request(goal));
  EXPECT_FALSE(validate_goal(goal, kJoints, false));
}

TEST(GoalValidation, RefusesVectorsOfWrongLength) {
  Goal goal = good();
  goal.points[1].positions = {1};
  expect_refused(goal, GoalError::InvalidGoal, kSizes, "points[1] has 1 positions for 2 joint names");
  goal = good();
  goal.points[0].positions = {};
  expect_refused(goal, GoalError::InvalidGoal, kSizes, "points[0] has 0 positions");
  goal = good();
  goal.points[1].velocities = {1, 2, 3};
  expect_refused(goal, GoalError::InvalidGoal, kSizes, "velocities");
  goal = good();
  goal.points[1].accelerations = {1};
  expect_refused(goal, GoalError::InvalidGoal, kSizes, "accelerations");
  goal = good();
  goal.points[1].efforts = {1};
  expect_refused(goal, GoalError::InvalidGoal, kSizes, "efforts");
}

TEST(GoalValidation, AcceptsVelocitiesInSomePointsOnly) {
  Goal goal = good();
  goal.points[0].velocities = {};
  goal.points[1].accelerations = {};
  EXPECT_FALSE(validate_goal(goal, kJoints, false));
}

TEST(GoalValidation, RefusesNumbersThatAreNone) {
  for (const double bad : {kNan, kInf, -kInf, 1e300}) {
    for (auto member :
         {&Waypoint::positions, &Waypoint::velocities, &Waypoint::accelerations, &Waypoint::efforts}) {
      Goal goal = good();
      goal.points[1].*member = {0, bad};
      expect_refused(goal, GoalError::InvalidGoal, "points[1]: ", "joint 'joint1'");
    }
  }
}

TEST(GoalValidation, BoundsTheNumberOfPoints) {
  Goal goal = good();
  const Waypoint point = goal.points.back();
  while (goal.points.size() < kMostPoints) {
    goal.points.push_back(point);
    goal.points.back().time = goal.points[goal.points.size() - 2].time + GoalTime{0.001};
  }
  EXPECT_FALSE(validate_goal(goal, kJoints, false));
  goal.points.push_back(goal.points.back());
  goal.points.back().time += GoalTime{0.001};
  expect_refused(goal, GoalError::InvalidGoal, "", "300001 points, allowed are at most 300000");
}

TEST(GoalValidation, RefusesPointsBeyondAnHour) {
  Goal goal = good();
  goal.points[1].time = GoalTime(3600);
  EXPECT_FALSE(validate_goal(goal, kJoints, false));
  goal.points[1].time = GoalTime(3601);
  expect_refused(goal, GoalError::InvalidGoal, "", "time_from_start is 3601 s, allowed is 0 s to 3600 s");
}

TEST(GoalValidation, RefusesWrongTimes) {
  Goal goal = good();
  goal.points[1].time = GoalTime(0);
  expect_refused(goal, GoalError::InvalidGoal, kTimes, "points[1] at 0.000000000 s");
  goal.points[0].time = GoalTime(2);
  goal.points[1].time = GoalTime(1);
  expect_refused(goal, GoalError::InvalidGoal, kTimes, "points[0]");
  goal.points[0].time = GoalTime(-1);
  expect_refused(goal, GoalError::InvalidGoal, "", "time_from_start is -1");
  for (const double bad : {kNan, kInf, 1e300}) {
    goal = good();
    goal.points[1].time = GoalTime(bad);
    expect_refused(goal, GoalError::InvalidGoal, "", "time_from_start");
  }
}

TEST(GoalValidation, RefusesWrongTolerances) {
  Goal goal = good();
  goal.path_tolerance = {{"elbow", 0.1, 0, 0}};
  expect_refused(goal, GoalError::InvalidJoints, "path_tolerance", "'elbow'");
  goal = good();
  goal.goal_tolerance = {{"joint1", 0.1, kNan, 0}};
  expect_refused(goal, GoalError::InvalidGoal, "goal_tolerance", "'joint1'");
  goal = good();
  goal.goal_time_tolerance = kInf;
  expect_refused(goal, GoalError::InvalidGoal, "goal_time_tolerance", "inf");
  goal = good();
  goal.path_tolerance = {{"joint1", -1, 0, 0.5}};
  EXPECT_FALSE(validate_goal(goal, kJoints, false));
}

}  // namespace
}  // namespace interpolated_motion::trajectory
