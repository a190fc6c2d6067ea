#include <regex>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/trajectory/goal_planner.h"
#include "trajectory/goals.h"

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

}  // namespace
}  // namespace interpolated_motion::trajectory
