#include "interpolated_motion_driver/trajectory/tolerances.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace interpolated_motion::trajectory {
namespace {

const std::vector<std::string> kJoints{"joint1", "joint2"};

Tolerances defaults() { return default_tolerances({0.1, 0.2}, {0.01, 0.0}, {0.05, 0.05}, 0.5); }

TEST(Tolerances, DefaultsComeFromTheParameters) {
  const Tolerances t = defaults();
  EXPECT_EQ(t.path[1].position, 0.2);
  EXPECT_EQ(t.path[1].velocity, 0.0);
  EXPECT_EQ(t.goal[0].position, 0.01);
  EXPECT_EQ(t.goal[0].velocity, 0.05);
  EXPECT_EQ(t.goal_time.count(), 0.5);
}

TEST(Tolerances, RefusesWrongParameters) {
  EXPECT_THROW(default_tolerances({0.1}, {0.1, 0.1}, {0, 0}, 0), std::invalid_argument);
  EXPECT_THROW(default_tolerances({-0.1}, {0.1}, {0}, 0), std::invalid_argument);
  EXPECT_THROW(default_tolerances({0.1}, {std::numeric_limits<double>::quiet_NaN()}, {0}, 0),
               std::invalid_argument);
  EXPECT_THROW(default_tolerances({0.1}, {0.1}, {-1}, 0), std::invalid_argument);
  EXPECT_THROW(default_tolerances({0.1}, {0.1}, {0}, -1), std::invalid_argument);
}

TEST(Tolerances, GoalSetsKeepsAndErases) {
  Goal goal;
  goal.path_tolerance = {{"joint2", 0.7, 0.3, 0.0}, {"joint1", -1.0, 0.0, 0.0}, {"stranger", 9, 9, 9}};
  goal.goal_tolerance = {{"joint1", 0.0, -1.0, 4.0}};
  goal.goal_time_tolerance = 2.0;
  const Tolerances t = merge_tolerances(defaults(), kJoints, goal);
  EXPECT_EQ(t.path[0].position, 0.0);
  EXPECT_EQ(t.path[1].position, 0.7);
  EXPECT_EQ(t.path[1].velocity, 0.3);
  EXPECT_EQ(t.goal[0].position, 0.01);
  EXPECT_EQ(t.goal[0].velocity, 0.0);
  EXPECT_EQ(t.goal[0].acceleration, 4.0);
  EXPECT_EQ(t.goal[1].velocity, 0.05);
  EXPECT_EQ(t.goal_time.count(), 2.0);
}

TEST(Tolerances, GoalTimeIsKeptOrErased) {
  Goal goal;
  EXPECT_EQ(merge_tolerances(defaults(), kJoints, goal).goal_time.count(), 0.5);
  goal.goal_time_tolerance = -1.0;
  EXPECT_EQ(merge_tolerances(defaults(), kJoints, goal).goal_time.count(), 0.0);
}

TEST(Tolerances, FindsTheFirstJointOutside) {
  const std::vector<State> desired{{1.0, 0, 0}, {2.0, 0, 0}};
  EXPECT_FALSE(find_tolerance_violation(defaults().path, desired, {{1.05, 9, 9}, {2.15, 9, 9}}));
  const auto violation = find_tolerance_violation(defaults().path, desired, {{1.05, 0, 0}, {1.75, 0, 0}});
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation->joint, 1u);
  EXPECT_EQ(violation->quantity, Quantity::Position);
  EXPECT_DOUBLE_EQ(violation->error, 0.25);
  EXPECT_EQ(violation->tolerance, 0.2);
}

TEST(Tolerances, ChecksVelocityAndAccelerationWhereAsked) {
  const std::vector<StateTolerance> tolerances{{0.0, 0.1, 0.0}, {0.0, 0.0, 0.5}};
  const std::vector<State> desired{{5, 0, 0}, {5, 0, 0}};
  EXPECT_FALSE(find_tolerance_violation(tolerances, desired, {{0, 0.1, 9}, {0, 9, 0.5}}));
  EXPECT_EQ(find_tolerance_violation(tolerances, desired, {{0, 0.2, 0}, {0, 0, 0}})->quantity,
            Quantity::Velocity);
  EXPECT_EQ(find_tolerance_violation(tolerances, desired, {{0, 0, 0}, {0, 0, 1}})->quantity,
            Quantity::Acceleration);
}

TEST(Tolerances, NotANumberIsOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(find_tolerance_violation({{0.1, 0, 0}}, {{0, 0, 0}}, {{nan, 0, 0}}));
}

TEST(Tolerances, TextsStartAsThoseOfJointTrajectoryController) {
  const auto violation = *find_tolerance_violation({{0.05, 0, 0}}, {{0.06, 0, 0}}, {{0, 0, 0}});
  const Refusal path = path_tolerance_violated("joint1", JointUnit::Radian, violation);
  EXPECT_EQ(path.code, GoalError::PathToleranceViolated);
  EXPECT_EQ(
      path.text.rfind(
          "joint1 path error 0.060000. The position of joint1 is off by 0.06 rad, allowed is 0.05 rad. ", 0),
      0u)
      << path.text;
  const Refusal goal = goal_tolerance_violated("joint1", JointUnit::Radian, violation);
  EXPECT_EQ(goal.code, GoalError::GoalToleranceViolated);
  EXPECT_EQ(goal.text.rfind("joint1 goal error 0.060000. ", 0), 0u) << goal.text;
  const Refusal slide = goal_tolerance_violated("slide", JointUnit::Metre, violation);
  EXPECT_NE(slide.text.find("is off by 0.06 m, allowed is 0.05 m. "), std::string::npos) << slide.text;
}

}  // namespace
}  // namespace interpolated_motion::trajectory
