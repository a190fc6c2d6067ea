#include "interpolated_motion_driver/trajectory/point_selection.h"

#include <gtest/gtest.h>

#include "trajectory/goals.h"

namespace interpolated_motion::trajectory {
namespace {

using Indices = std::vector<std::size_t>;

Goal goal_at(const std::vector<double>& times, const std::vector<double>& positions) {
  Goal goal;
  goal.joint_names = {"joint1"};
  for (std::size_t i = 0; i < times.size(); ++i) goal.points.push_back(point(times[i], {positions[i]}));
  return goal;
}

GoalRules revolute() { return rules_for(1); }

GoalRules prismatic() {
  JointLimits limits;
  limits.unit = JointUnit::Metre;
  return rules_for(1, limits);
}

TEST(DropPastPoints, KeepsAllWithoutStampOrBeforeIt) {
  Goal goal = goal_at({0, 1, 2}, {0, 1, 2});
  EXPECT_EQ(drop_past_points(goal, host_time(100)).value().first, 0u);
  goal.start = host_time(101);
  const auto kept = drop_past_points(goal, host_time(100)).value();
  EXPECT_EQ(kept.first, 0u);
  EXPECT_EQ(kept.skipped.count(), 0.0);
  EXPECT_EQ(kept.warning, "");
}

TEST(DropPastPoints, DropsThoseBeforeNow) {
  Goal goal = goal_at({0, 1, 2}, {0, 1, 2});
  goal.start = host_time(98.75);
  const auto kept = drop_past_points(goal, host_time(100)).value();
  EXPECT_EQ(kept.first, 2u);
  EXPECT_DOUBLE_EQ(kept.skipped.count(), 1.25);
  EXPECT_EQ(kept.warning.rfind(
                "Dropping first 2 trajectory point(s) out of 3, as they occur before the current time.\n"
                "First valid point will be reached in 0.750s.",
                0),
            0u)
      << kept.warning;
}

TEST(DropPastPoints, DropsThePointThatIsDueNow) {
  Goal goal = goal_at({0, 1, 2}, {0, 1, 2});
  goal.start = host_time(99);
  EXPECT_EQ(drop_past_points(goal, host_time(100)).value().first, 2u);
}

TEST(DropPastPoints, RefusesAGoalThatIsOver) {
  Goal goal = goal_at({0, 1, 2}, {0, 1, 2});
  goal.start = host_time(97.5);
  const auto refusal = drop_past_points(goal, host_time(100)).error();
  EXPECT_EQ(refusal.code, GoalError::InvalidGoal);
  EXPECT_EQ(refusal.text.rfind("Dropping all 3 trajectory point(s), as they occur before the current time.\n"
                               "Last point is 0.500000s in the past. ",
                               0),
            0u)
      << refusal.text;
}

// Whoever has accepted it keeps its end, and says how late it is met.
TEST(DropPastPoints, KeepsTheLastOfAGoalThatIsOverWhereThatIsWanted) {
  Goal goal = goal_at({0, 1, 2}, {0, 1, 2});
  goal.start = host_time(97.5);
  const auto kept = drop_past_points(goal, host_time(100), true).value();
  EXPECT_EQ(kept.first, 2u);
  EXPECT_GT(2.0 - kept.skipped.count(), kMinimumStep.count());  // later than now
  EXPECT_DOUBLE_EQ(kept.skipped.count() + kept.late.count(), 2.5);
  EXPECT_NE(kept.warning.find("Dropping first 2 trajectory point(s) out of 3"), std::string::npos);
}

// Nothing can be done in the time that is left: it is as good as over.
TEST(DropPastPoints, KeepsTheLastThatIsDueAtOnceWhereThatIsWanted) {
  Goal goal = goal_at({0, 2}, {0, 2});
  goal.start = host_time(98) + std::chrono::microseconds(50);
  const auto kept = drop_past_points(goal, host_time(100), true).value();
  EXPECT_EQ(kept.first, 1u);
  EXPECT_GT(kept.late.count(), 0.0);
  EXPECT_EQ(drop_past_points(goal, host_time(100)).value().late.count(), 0.0);
}

TEST(MergeNearPoints, KeepsWhatIsFarEnoughApart) {
  EXPECT_EQ(merge_near_points(goal_at({0, 1, 1.0001, 2}, {0, 1, 1.5, 2}), revolute(), 0).value(),
            (Indices{0, 1, 2, 3}));
  EXPECT_EQ(merge_near_points(goal_at({0, 1, 2}, {0, 1, 2}), revolute(), 1).value(), (Indices{1, 2}));
}

TEST(MergeNearPoints, KeepsTheLastOfALastStepOfNanoseconds) {
  EXPECT_EQ(merge_near_points(goal_at({0, 1, 1 + 3e-9}, {0, 1, 1}), revolute(), 0).value(), (Indices{0, 2}));
  EXPECT_EQ(
      merge_near_points(goal_at({0, 1, 1 + 3e-9, 1 + 6e-9}, {0, 1, 1, 1 + 1e-9}), revolute(), 0).value(),
      (Indices{0, 3}));
}

TEST(MergeNearPoints, KeepsTheEarlierElsewhere) {
  EXPECT_EQ(merge_near_points(goal_at({0, 1, 1.00005, 2}, {0, 1, 1, 2}), revolute(), 0).value(),
            (Indices{0, 1, 3}));
  EXPECT_EQ(merge_near_points(goal_at({0, 1e-9, 2}, {0, 0, 2}), revolute(), 0).value(), (Indices{0, 2}));
}

// 1 um is a fifth of a count of an arm's joint, and some counts of a good screw.
TEST(MergeNearPoints, ALengthIsDroppedUpToATenthOfAMicrometre) {
  const auto move_by = [](double length) { return goal_at({0, 1, 1 + 3e-9}, {0, 1, 1 + length}); };
  EXPECT_TRUE(merge_near_points(move_by(0.9e-7), prismatic(), 0).has_value());
  EXPECT_TRUE(merge_near_points(move_by(0.9e-6), revolute(), 0).has_value());
  const auto refusal = merge_near_points(move_by(0.9e-6), prismatic(), 0).error();
  EXPECT_NE(refusal.text.find("by 9e-07 m; the shortest"), std::string::npos) << refusal.text;
}

TEST(MergeNearPoints, RefusesAJumpInNoTime) {
  const auto refusal = merge_near_points(goal_at({0, 1, 1 + 3e-9}, {0, 1, 1.001}), revolute(), 0).error();
  EXPECT_EQ(refusal.code, GoalError::InvalidGoal);
  EXPECT_NE(
      refusal.text.find("points[1] and points[2] are 3e-09 s apart and move joint 'joint1' by 0.001 rad"),
      std::string::npos)
      << refusal.text;
}

}  // namespace
}  // namespace interpolated_motion::trajectory
