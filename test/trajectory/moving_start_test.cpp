#include <cmath>
#include <regex>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "interpolated_motion_driver/trajectory/limits_check.h"
#include "trajectory/goals.h"
#include "trajectory/random.h"

// Goals that begin while the joints move: the first point left is reached at its time from the state that
// they are in.
namespace interpolated_motion::trajectory {
namespace {

const HostTime kNow = host_time(1000);
const State kMoving{1.0, 0.5, 0.25};

Expected<GoalPlan, Refusal> plan(const std::vector<Waypoint>& points, const std::vector<State>& present,
                                 const JointLimits& limits = {}) {
  Goal goal;
  goal.points = points;
  const GoalRules rules = rules_for(present.size(), limits);
  goal.joint_names = rules.joints;
  return plan_goal(goal, rules, present, kNow);
}

/// Two points within reach of each other, with or without velocities.
std::vector<Waypoint> random_points(Random& random, std::size_t joints) {
  std::vector<Waypoint> points(2);
  points[0].time = GoalTime{random.uniform(0.01, 2.0)};
  points[1].time = points[0].time + GoalTime{random.uniform(3.0, 4.0)};
  for (std::size_t joint = 0; joint < joints; ++joint) {
    points[0].positions.push_back(random.uniform(-1.0, 1.0));
    points[1].positions.push_back(points[0].positions.back() + random.uniform(-0.5, 0.5));
  }
  if (random.integer(0, 1) == 0) return points;
  for (Waypoint& point : points) point.velocities.assign(joints, 0.0);
  return points;
}

TEST(MovingStart, GoesOnFromPositionVelocityAndAcceleration) {
  const auto goal = plan({point(2, {3}, {0}, {0})}, {kMoving});
  ASSERT_TRUE(goal) << goal.error().text;
  const Path& path = goal.value().paths[0];
  const State begin = path.sample(path.start_time());
  EXPECT_NEAR(begin.position, 1.0, 1e-12);
  EXPECT_NEAR(begin.velocity, 0.5, 1e-12);
  EXPECT_NEAR(begin.acceleration, 0.25, 1e-12);
  const State end = path.sample(path.start_time() + GoalTime(2));
  EXPECT_NEAR(end.position, 3.0, 1e-12);
  EXPECT_NEAR(end.velocity, 0.0, 1e-12);
}

TEST(MovingStart, NeedsNoPointWhereTheJointIs) {
  const auto goal = plan({point(0, {-2}), point(4, {3})}, {kMoving});
  ASSERT_TRUE(goal) << goal.error().text;
  EXPECT_NEAR(goal.value().paths[0].sample(goal.value().paths[0].start_time()).position, 1.0, 1e-12);
  EXPECT_NEAR(goal.value().paths[0].final_position(), 3.0, 1e-12);
}

TEST(MovingStart, OfOneJointIsEnough) {
  const auto goal = plan({point(2, {3, 4})}, {kMoving, State{4.0, 0.0, 0.0}});
  ASSERT_TRUE(goal) << goal.error().text;
  EXPECT_NEAR(goal.value().paths[1].sample(GoalTime(0)).position, 4.0, 1e-12);
}

// The time that a refusal names is enough, and four fifths of it are not.
TEST(MovingStart, ThatIsTooFastIsRefusedWithTheTimeItTakes) {
  const JointLimits limits = limits_of(1.0, 2.0);
  const auto refused = plan({point(0.5, {3})}, {kMoving}, limits);
  ASSERT_FALSE(refused);
  std::smatch least;
  const std::string text = refused.error().text;
  ASSERT_TRUE(std::regex_search(text, least, std::regex("It takes ([0-9.]+) s at least"))) << text;
  const double time = std::stod(least[1]) + 0.005;
  EXPECT_TRUE(plan({point(time, {3})}, {kMoving}, limits)) << text;
  EXPECT_FALSE(plan({point(0.8 * time, {3})}, {kMoving}, limits)) << text;
}

// Goals of random points for three joints in random states of motion: each is met as it is, or later, by no
// more than it takes.
TEST(MovingStart, JoinsLateByWhatTheWayLacks) {
  Random random(5);
  int late = 0;
  const int cases = property_cases(400);
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE(i);
    GoalRules rules = rules_for(3, limits_of(2.0, 6.0));
    const std::vector<Waypoint> points = random_points(random, rules.joints.size());
    std::vector<State> present(rules.joints.size());
    for (State& state : present) state = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.0};
    Goal goal;
    goal.joint_names = rules.joints;
    goal.points = points;
    const auto on_time = plan_goal(goal, rules, present, kNow);
    rules.join_late = true;
    const auto planned = plan_goal(goal, rules, present, kNow);
    ASSERT_TRUE(planned) << planned.error().text;
    const GoalTime lateness = GoalTime{0.0} - planned.value().skipped;
    EXPECT_EQ(lateness.count() == 0.0, bool(on_time));
    EXPECT_EQ(planned.value().warnings.empty(), bool(on_time));
    late += lateness.count() > 0.0 ? 1 : 0;
    EXPECT_LE(lateness.count(), 4.0);  // the farthest way, from 2 m/s to rest and back
    for (std::size_t joint = 0; joint < present.size(); ++joint) {
      const Path& path = planned.value().paths[joint];
      EXPECT_FALSE(find_limit_violation(path, rules.limits[joint]));
      EXPECT_NEAR(path.sample(GoalTime{0.0}).velocity, present[joint].velocity, 1e-9);
      for (const Waypoint& point : points)
        EXPECT_NEAR(path.sample(point.time + lateness).position, point.positions[joint], 1e-9);
    }
  }
  EXPECT_GT(late, cases / 4);
  EXPECT_LT(late, cases);
}

// Accepted in time, and over when the joints have come to rest: the end is met from there, within the limits.
TEST(MovingStart, OfAGoalThatIsOverMeetsItsLastPointLate) {
  GoalRules rules = rules_for(1, limits_of(1.0, 2.0));
  Goal goal;
  goal.joint_names = rules.joints;
  goal.points = {point(0.5, {1}), point(1, {3})};
  goal.start = host_time(998);
  rules.join_late = true;
  EXPECT_FALSE(plan_goal(goal, rules, {State{2.0, 0.0, 0.0}}, kNow));
  rules.keep_last_point = true;
  const auto planned = plan_goal(goal, rules, {State{2.0, 0.0, 0.0}}, kNow);
  ASSERT_TRUE(planned) << planned.error().text;
  const Path& path = planned.value().paths[0];
  EXPECT_FALSE(find_limit_violation(path, rules.limits[0]));
  EXPECT_NEAR(path.sample(GoalTime{0.0}).position, 2.0, 1e-12);
  EXPECT_NEAR(path.final_position(), 3.0, 1e-12);
  EXPECT_NEAR(path.sample(GoalTime{1.0} - planned.value().skipped).position, 3.0, 1e-12);
  EXPECT_NEAR(path.sample(path.end_time()).acceleration, 0.0, 1e-9) << "no step, as drives follow it badly";
  EXPECT_NE(planned.value().warnings.back().find(" s late"), std::string::npos);
}

// Points of a smooth curve, positions only, that are followed within the limits from the first one on. Those
// of the past are left out; what is left is the same curve, however the joint comes to it.
TEST(MovingStart, KeepsTheCurveThroughThePointsThatAreLeft) {
  GoalRules rules = rules_for(1, limits_of(2.0, 6.0));
  Goal goal;
  goal.joint_names = rules.joints;
  constexpr int kPoints = 25;
  constexpr double kPi = 3.14159265358979;
  for (int i = 0; i <= kPoints; ++i)
    goal.points.push_back(point(1.5 * i / kPoints, {0.5 - 0.5 * std::cos(kPi * i / kPoints)}));
  const auto whole = plan_goal(goal, rules, {State{}}, kNow);
  ASSERT_TRUE(whole) << whole.error().text;
  rules.join_late = true;
  for (const double age : {0.1, 0.5, 0.9, 1.3}) {
    goal.start = host_time(1000.0 - age);
    for (const State& present : {State{0.9, 0.0, 0.0}, State{-0.3, 0.0, 0.0}, State{0.5, -0.5, 0.0}}) {
      SCOPED_TRACE(::testing::Message() << age << " s late, from " << present.position);
      const auto left = plan_goal(goal, rules, {present}, kNow);
      ASSERT_TRUE(left) << left.error().text;
      const Path& path = left.value().paths[0];
      EXPECT_FALSE(find_limit_violation(path, rules.limits[0]));
      for (double time = age + 1.5 / kPoints; time <= 1.5; time += 0.01) {
        const State wanted = whole.value().paths[0].sample(GoalTime{time});
        const State state = path.sample(GoalTime{time} - left.value().skipped);
        ASSERT_NEAR(state.position, wanted.position, 1e-9) << time;
        ASSERT_NEAR(state.velocity, wanted.velocity, 1e-9) << time;
      }
    }
  }
}

// What is behind the first point is not a matter of when it is met.
TEST(MovingStart, IsNotMadeLateForWhatComesBehindIt) {
  GoalRules rules = rules_for(1, limits_of(1.0, 2.0));
  rules.join_late = true;
  Goal goal;
  goal.joint_names = rules.joints;
  goal.points = {point(2, {1}, {0}, {0}), point(2.1, {2}, {0}, {0})};
  const auto refused = plan_goal(goal, rules, {kMoving}, kNow);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text.find("on the way from"), std::string::npos) << refused.error().text;
}

}  // namespace
}  // namespace interpolated_motion::trajectory
