#include "interpolated_motion_driver/trajectory/goal_planner.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "trajectory/goals.h"

namespace interpolated_motion::trajectory {
namespace {

constexpr double kPi = 3.14159265358979323846;
const HostTime kNow = host_time(1000);

Goal one_joint(std::vector<Waypoint> points) {
  Goal goal;
  goal.joint_names = {"joint1"};
  goal.points = std::move(points);
  return goal;
}

GoalPlan plan_one(std::vector<Waypoint> points, double present = 0.0, const JointLimits& limits = {}) {
  auto plan = plan_goal(one_joint(std::move(points)), rules_for(1, limits), {{present, 0, 0}}, kNow);
  EXPECT_TRUE(plan.has_value()) << plan.error().text;
  return std::move(plan).value();
}

std::string refusal_of_one(std::vector<Waypoint> points, double present = 0.0,
                           const JointLimits& limits = {}) {
  const auto plan = plan_goal(one_joint(std::move(points)), rules_for(1, limits), {{present, 0, 0}}, kNow);
  EXPECT_TRUE(plan.has_error());
  return plan.has_error() ? plan.error().text : "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(GoalPlanner, StartsAtTheFirstPoint) {
  const GoalPlan plan = plan_one({point(0, {0}), point(1, {1}), point(3, {2})});
  EXPECT_EQ(plan.lead_in.count(), 0.0);
  EXPECT_EQ(plan.duration.count(), 3.0);
  EXPECT_TRUE(plan.warnings.empty());
  EXPECT_EQ(plan.paths[0].start_time().count(), 0.0);
  EXPECT_EQ(plan.paths[0].end_time().count(), 3.0);
  EXPECT_EQ(plan.paths[0].sample(GoalTime(1)).position, 1.0);
  EXPECT_NEAR(plan.paths[0].final_position(), 2.0, 1e-15);
}

JointLimits of_a_slide(double velocity, double acceleration) {
  JointLimits limits = limits_of(velocity, acceleration);
  limits.unit = JointUnit::Metre;
  return limits;
}

TEST(GoalPlanner, SpeaksOfMetresToAPrismaticJoint) {
  const JointLimits slide = of_a_slide(0.1, 1.0);
  EXPECT_TRUE(contains(refusal_of_one({point(0, {0.5}), point(1, {0.5})}, 0.25, slide),
                       "starts at 0.5 m, but the joint is at 0.25 m; allowed is a difference of 0.1 m"));
  EXPECT_TRUE(
      contains(refusal_of_one({point(0, {0}), point(0.5, {0.2})}, 0, slide), "allowed is -0.1 to 0.1 m/s."));
  EXPECT_TRUE(contains(refusal_of_one({point(0, {0}), point(0.1, {0.005})}, 0, of_a_slide(1, 1)),
                       "allowed is -1 to 1 m/s^2."));
}

// 1 mm/s is no rest for a screw: at 1 m/s^2 it takes a ms to lose it, at 0.1 m/s^2 ten.
TEST(GoalPlanner, APrismaticJointRestsBelowATenthOfAMillimetreASecond) {
  const std::vector<Waypoint> ends_at_5e_4{point(0, {0}), point(1, {0.01}, {5e-4})};
  EXPECT_TRUE(contains(refusal_of_one(ends_at_5e_4, 0, of_a_slide(0.1, 1.0)),
                       "has a velocity of 0.0005 m/s, allowed is 0.0001 at most"));
  plan_one(ends_at_5e_4, 0, limits_of(0.1, 1.0));
}

TEST(GoalPlanner, NeedsNoLeadInBelowTheThreshold) {
  const GoalPlan plan = plan_one({point(0, {0}), point(1, {1})}, 0.00009);
  EXPECT_EQ(plan.lead_in.count(), 0.0);
  EXPECT_EQ(plan.paths[0].sample(GoalTime(0)).position, 0.0);
}

TEST(GoalPlanner, LeadsInAllJointsTogether) {
  Goal goal;
  goal.joint_names = {"joint1", "joint2"};
  goal.points = {point(0, {0, 5}), point(1, {0.1, 5})};
  const JointLimits limits = limits_of(1.0, 1.0);
  const auto plan = plan_goal(goal, rules_for(2, limits), {{0.05, 0, 0}, {5, 0, 0}}, kNow).value();
  // 0.05 rad at half of 1 rad/s^2: T = sqrt(10/sqrt(3) * 0.05 / 0.5) = 0.7598 s.
  EXPECT_DOUBLE_EQ(plan.lead_in.count(), 0.760);
  for (const Path& path : plan.paths) {
    EXPECT_DOUBLE_EQ(path.start_time().count(), -0.760);
    EXPECT_EQ(path.end_time().count(), 1.0);
  }
  EXPECT_EQ(plan.paths[0].sample(GoalTime(-0.760)).position, 0.05);
  EXPECT_EQ(plan.paths[0].sample(GoalTime(0)).position, 0.0);
  EXPECT_NEAR(plan.paths[0].sample(GoalTime(-1e-12)).position, 0.0, 1e-12);
  EXPECT_LE(std::abs(plan.paths[0].sample(GoalTime(-0.38)).velocity), 0.5);
}

TEST(GoalPlanner, LeadsInForAtLeastTwentyMilliseconds) {
  EXPECT_DOUBLE_EQ(plan_one({point(0, {0}), point(1, {1})}, 0.01).lead_in.count(), 0.020);
}

// For a drive that goes beyond the limits between the target positions of so short a lead-in.
TEST(GoalPlanner, LeadsInForLongerWhereThatIsAskedFor) {
  GoalRules rules = rules_for(1);
  rules.least_late = GoalTime{0.1};
  const Goal goal = one_joint({point(0, {0}), point(1, {1})});
  const auto plan = plan_goal(goal, rules, {{0.01, 0, 0}}, kNow).value();
  EXPECT_DOUBLE_EQ(plan.lead_in.count(), 0.120);
  EXPECT_DOUBLE_EQ(plan.paths[0].start_time().count(), -0.120);
  EXPECT_EQ(plan.duration.count(), 1.0) << "no point is met later";
  EXPECT_TRUE(plan.warnings.empty());
  EXPECT_EQ(plan_goal(goal, rules, {{0, 0, 0}}, kNow).value().lead_in.count(), 0.0);
}

TEST(GoalPlanner, RefusesAStartFarFromThePresentPosition) {
  const std::string text = refusal_of_one({point(0, {0.5}), point(1, {1})}, 0.25);
  EXPECT_TRUE(contains(text, "joint1: the trajectory starts at 0.5 rad, but the joint is at 0.25 rad"))
      << text;
  EXPECT_TRUE(contains(text, "difference of 0.1")) << text;
}

TEST(GoalPlanner, BridgesToAFirstPointThatIsLater) {
  const GoalPlan positions = plan_one({point(2, {1}), point(3, {2})});
  EXPECT_EQ(positions.paths[0].sample(GoalTime(0)).position, 0.0);
  EXPECT_EQ(positions.paths[0].sample(GoalTime(2)).position, 1.0);
  EXPECT_GT(positions.paths[0].sample(GoalTime(2)).velocity, 0.0);
  const GoalPlan velocities = plan_one({point(2, {1}, {0.5}), point(3, {2}, {0})});
  EXPECT_EQ(velocities.paths[0].sample(GoalTime(2)).velocity, 0.5);
  EXPECT_EQ(velocities.paths[0].pieces()[0].polynomial.coefficients[5], 0.0);
  const GoalPlan accelerations = plan_one({point(2, {1}, {0.5}, {0.3}), point(3, {2}, {0}, {0})});
  EXPECT_NEAR(accelerations.paths[0].sample(GoalTime(2 - 1e-9)).acceleration, 0.3, 1e-6);
  EXPECT_EQ(accelerations.paths[0].sample(GoalTime(0)).acceleration, 0.0);
}

TEST(GoalPlanner, TakesASinglePointThatIsLater) {
  const GoalPlan plan = plan_one({point(1, {0.7})});
  EXPECT_NEAR(plan.paths[0].final_position(), 0.7, 1e-15);
  EXPECT_EQ(plan.duration.count(), 1.0);
}

TEST(GoalPlanner, RefusesASinglePointAtZero) {
  const std::string text = refusal_of_one({point(0, {0})});
  EXPECT_EQ(
      text.rfind("Dropping all 1 trajectory point(s), as they occur before the current time.\nLast point is "
                 "0.000000s in the past. ",
                 0),
      0u)
      << text;
}

TEST(GoalPlanner, ReplacesAMovingStartByThePresentState) {
  const GoalPlan plan = plan_one({point(0, {0.05}, {0.5}), point(1, {1}, {0.5}), point(2, {1.2}, {0})});
  ASSERT_EQ(plan.warnings.size(), 1u);
  EXPECT_TRUE(contains(plan.warnings[0], "joint1: the trajectory starts with a velocity of 0.5"))
      << plan.warnings[0];
  EXPECT_EQ(plan.paths[0].sample(GoalTime(0)).position, 0.0);
  EXPECT_EQ(plan.paths[0].sample(GoalTime(0)).velocity, 0.0);
  EXPECT_EQ(plan.paths[0].sample(GoalTime(1)).velocity, 0.5);
}

TEST(GoalPlanner, TellsThatABridgeIsTooFast) {
  const std::string text = refusal_of_one(
      {point(0, {0}, {1.0}), point(0.02, {0.02}, {1.0}), point(2, {1}, {0})}, 0.0, limits_of(2, 5));
  EXPECT_TRUE(contains(text, "on the way from rest at the present position 0 rad to points[1]")) << text;
}

TEST(GoalPlanner, TakesNoiseAtTheEndsForRest) {
  const GoalPlan plan = plan_one({point(0, {0}, {1e-7}), point(1, {1}, {9e-4})});
  EXPECT_TRUE(plan.warnings.empty());
  EXPECT_EQ(plan.paths[0].sample(GoalTime(0)).velocity, 0.0);
  EXPECT_NEAR(plan.paths[0].sample(GoalTime(1)).velocity, 0.0, 1e-14);
}

TEST(GoalPlanner, RefusesAnEndThatMoves) {
  const std::string text = refusal_of_one({point(0, {0}, {0}), point(1, {1}, {-0.2})});
  EXPECT_TRUE(
      contains(text, "joint1: the last point, points[1], has a velocity of -0.2 rad/s, allowed is 0.001"))
      << text;
}

TEST(GoalPlanner, RefusesWhatLeavesTheLimitsBetweenThePoints) {
  // 1 rad in 1 s with zero velocities: the cubic peaks at 1.5 rad/s.
  const std::string text = refusal_of_one({point(0, {0}, {0}), point(1, {1}, {0})}, 0.0, limits_of(1.4, 100));
  EXPECT_TRUE(
      contains(text, "joint1: the velocity reaches 1.5 rad/s at 0.500000 s, allowed is -1.4 to 1.4 rad/s."))
      << text;
  // joint_trajectory_controller accepts 50 rad in 0.5 s on a joint of 6.28 rad/s.
  EXPECT_TRUE(contains(refusal_of_one({point(0.5, {50})}, 0.0, limits_of(6.28, 1e9)), "velocity"));
}

TEST(GoalPlanner, ShiftsAContinuousJointToTheNearestTurn) {
  JointLimits limits;
  limits.continuous = true;
  const double present = 4 * kPi - 0.05;
  const GoalPlan plan = plan_one({point(0, {0}), point(1, {1}), point(2, {7})}, present, limits);
  EXPECT_NEAR(plan.paths[0].sample(GoalTime(0)).position, 4 * kPi, 1e-14);
  EXPECT_NEAR(plan.paths[0].final_position(), 4 * kPi + 7, 1e-14);
  EXPECT_GT(plan.lead_in.count(), 0.0);
  EXPECT_TRUE(contains(refusal_of_one({point(0, {0}), point(1, {1})}, present), "starts at 0"));
}

/// Where a continuous joint that stands at `present` goes when it is sent to `target`.
double continuous_end(double present, double target) {
  JointLimits limits;
  limits.continuous = true;
  return plan_one({point(1, {target})}, present, limits).paths[0].final_position();
}

// At half a turn both ways are as near. A joint rests some counts off, and people write three decimals.
TEST(GoalPlanner, TurnsAContinuousJointByHalfATurnAsTheNumbersSay) {
  for (const double off : {0.0, 1e-9, -1e-9, 1e-4, -1e-4, 1e-3, -1e-3}) {
    EXPECT_NEAR(continuous_end(-kPi / 2 + off, kPi / 2), kPi / 2, 1e-14) << off;
    EXPECT_NEAR(continuous_end(kPi / 2 + off, -kPi / 2), -kPi / 2, 1e-14) << off;
    EXPECT_NEAR(continuous_end(off, kPi), kPi, 1e-14) << off;
    EXPECT_NEAR(continuous_end(off, -kPi), -kPi, 1e-14) << off;
  }
  EXPECT_NEAR(continuous_end(-1.571, 1.571), 1.571, 1e-14);
}

TEST(GoalPlanner, TurnsAContinuousJointTheShorterWayOtherwise) {
  EXPECT_NEAR(continuous_end(-kPi / 2 - 0.01, kPi / 2), kPi / 2 - 2 * kPi, 1e-14);
  EXPECT_NEAR(continuous_end(kPi / 2 + 0.01, -kPi / 2), -kPi / 2 + 2 * kPi, 1e-14);
  EXPECT_NEAR(continuous_end(7.0, 0.0), 2 * kPi, 1e-14);
}

// Turned more than once, half a turn goes back: cables are not wound up further.
TEST(GoalPlanner, UnwindsAContinuousJointAtHalfATurn) {
  EXPECT_NEAR(continuous_end(3 * kPi, 0.0), 2 * kPi, 1e-14);
  EXPECT_NEAR(continuous_end(-3 * kPi, 0.0), -2 * kPi, 1e-14);
  double position = 0.0;
  for (int i = 0; i < 20; ++i) {
    for (const double target : {kPi / 2, -kPi / 2, kPi / 2, 0.0})
      position = continuous_end(position + 3e-5, target);
    EXPECT_NEAR(position, 0.0, 1e-12);
  }
}

TEST(GoalPlanner, RecognisesAStopAtEveryPoint) {
  const JointLimits limits = limits_of(3.0, 2.0);
  const auto text = refusal_of_one(
      {point(0, {0}, {0}), point(0.5, {0.2}, {0}), point(1, {0.4}, {0}), point(1.5, {0.6}, {0})}, 0.0,
      limits);
  EXPECT_TRUE(contains(text, "the acceleration")) << text;
  EXPECT_TRUE(contains(text, "Every point has velocity 0, so the trajectory stops at each of them")) << text;
  const auto without =
      refusal_of_one({point(0, {0}, {0}), point(0.5, {0.2}, {0.4}), point(1, {0.9}, {0})}, 0.0, limits);
  EXPECT_FALSE(contains(without, "Every point")) << without;
  const auto two = refusal_of_one({point(0, {0}, {0}), point(0.5, {0.9}, {0})}, 0.0, limits);
  EXPECT_FALSE(contains(two, "Every point")) << two;
}

TEST(GoalPlanner, LetsUnnamedJointsRest) {
  GoalRules rules = rules_for(2, limits_of(3, 10));
  const Goal goal = one_joint({point(0, {0}), point(1, {1})});
  EXPECT_EQ(plan_goal(goal, rules, {{0.05, 0, 0}, {9, 0, 0}}, kNow).error().code, GoalError::InvalidJoints);
  rules.allow_partial_joints = true;
  const auto plan = plan_goal(goal, rules, {{0.05, 0, 0}, {9, 0, 0}}, kNow).value();
  EXPECT_EQ(plan.paths[1].start_time(), plan.paths[0].start_time());
  EXPECT_EQ(plan.paths[1].end_time(), plan.paths[0].end_time());
  EXPECT_EQ(plan.paths[1].sample(GoalTime(0.5)).position, 9.0);
  EXPECT_EQ(plan.paths[1].sample(GoalTime(0.5)).velocity, 0.0);
}

TEST(GoalPlanner, DropsThePastAndShiftsTheRest) {
  Goal goal = one_joint({point(0, {0}), point(1, {1}), point(2, {1.5})});
  goal.start = kNow - host_duration(1.25);
  const auto plan = plan_goal(goal, rules_for(1), {{0.3, 0, 0}}, kNow).value();
  EXPECT_DOUBLE_EQ(plan.skipped.count(), 1.25);
  EXPECT_DOUBLE_EQ(plan.duration.count(), 0.75);
  EXPECT_EQ(plan.paths[0].sample(GoalTime(0)).position, 0.3);
  EXPECT_NEAR(plan.paths[0].final_position(), 1.5, 1e-15);
  ASSERT_EQ(plan.warnings.size(), 1u);
}

TEST(GoalPlanner, NamesTheTimeOfTheGoalWhenThePastIsDropped) {
  Goal goal = one_joint({point(0, {0}), point(1, {1}), point(2, {2}), point(3, {3})});
  goal.start = kNow - host_duration(0.5);
  // From rest at 0 to the point at 1 s, which is left half a second: 1 rad at a mean of 2 rad/s.
  const auto plan = plan_goal(goal, rules_for(1, limits_of(1.9, 1000)), {{0, 0, 0}}, kNow);
  ASSERT_TRUE(plan.has_error());
  const std::size_t at = plan.error().text.find(" at 0.");
  ASSERT_NE(at, std::string::npos) << plan.error().text;
  EXPECT_GT(std::stod(plan.error().text.substr(at + 4)), 0.5);
  EXPECT_TRUE(contains(plan.error().text, "to points[1], for which there are 0.500000 s"))
      << plan.error().text;
}

TEST(GoalPlanner, RefusesARequestToStop) { EXPECT_TRUE(contains(refusal_of_one({}), "no points")); }

TEST(GoalPlanner, WarnsOfAccelerationsItCannotUse) {
  const GoalPlan plan = plan_one({point(0, {0}, {}, {1}), point(1, {1})});
  ASSERT_EQ(plan.warnings.size(), 1u);
  EXPECT_TRUE(contains(plan.warnings[0], "points[0]"));
  EXPECT_EQ(plan.paths[0].sample(GoalTime(0)).velocity, 0.0);
}

TEST(GoalPlanner, ThrowsWhenItsArgumentsDoNotMatch) {
  const Goal goal = one_joint({point(1, {0})});
  EXPECT_THROW(static_cast<void>(plan_goal(goal, rules_for(1), {}, kNow)), std::invalid_argument);
  GoalRules rules = rules_for(1);
  rules.lead_in_threshold.clear();
  EXPECT_THROW(static_cast<void>(plan_goal(goal, rules, {{0, 0, 0}}, kNow)), std::invalid_argument);
}

}  // namespace
}  // namespace interpolated_motion::trajectory
