#include "interpolated_motion_driver/node/message_conversion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "interpolated_motion_driver/node/clock.h"

namespace interpolated_motion::node {
namespace {

class MessageConversion : public testing::Test {
 protected:
  static void SetUpTestSuite() { ros::Time::init(); }
};

motion::Snapshot snapshot() {
  motion::Snapshot result;
  result.time = host_now();
  result.goal_time = GoalTime(1.25);
  result.buses.emplace_back();
  result.buses.back().name = "can0";
  result.buses.back().load = 0.125;
  for (const char* name : {"joint1", "joint2"}) {
    motion::JointSnapshot joint;
    joint.joint = name;
    joint.bus = "can0";
    joint.online = true;
    joint.desired = {1.0, 2.0, 3.0};
    joint.actual = {0.75, 1.5, 0.0};
    result.joints.push_back(joint);
  }
  return result;
}

TEST_F(MessageConversion, StampZeroMeansAtOnce) {
  EXPECT_FALSE(to_goal(trajectory_msgs::JointTrajectory()).start);
}

TEST_F(MessageConversion, AStampIsTakenOverToTheHostClock) {
  trajectory_msgs::JointTrajectory message;
  message.header.stamp = ros::Time::now() + ros::Duration(2.0);
  const auto start = to_goal(message).start;
  ASSERT_TRUE(start);
  EXPECT_NEAR(seconds(*start - host_now()), 2.0, 0.5);
}

TEST_F(MessageConversion, TheLastStampThereIsDoesNotOverflow) {
  EXPECT_GT(to_host_time(ros::Time(4294967295U, 999999999U)), host_now() + std::chrono::hours(24 * 365));
}

TEST_F(MessageConversion, StampsSurviveTheWayThereAndBack) {
  const ros::Time stamp = ros::Time::now() + ros::Duration(10.0);
  EXPECT_NEAR((to_ros_time(to_host_time(stamp)) - stamp).toSec(), 0.0, 0.01);
}

TEST_F(MessageConversion, AGoalKeepsEverything) {
  control_msgs::FollowJointTrajectoryGoal message;
  message.trajectory.joint_names = {"joint2", "joint1"};
  message.trajectory.points.resize(1);
  auto& point = message.trajectory.points[0];
  point.positions = {1, 2};
  point.velocities = {3, 4};
  point.accelerations = {5, 6};
  point.effort = {7, 8};
  point.time_from_start = ros::Duration(-1, 500000000);
  message.path_tolerance.resize(1);
  message.path_tolerance[0].name = "joint1";
  message.path_tolerance[0].position = 0.1;
  message.goal_tolerance.resize(2);
  message.goal_tolerance[1].velocity = -1.0;
  message.goal_time_tolerance = ros::Duration(0.25);

  const trajectory::Goal goal = to_goal(message);
  EXPECT_EQ(goal.joint_names, message.trajectory.joint_names);
  ASSERT_EQ(goal.points.size(), 1U);
  EXPECT_EQ(goal.points[0].positions, point.positions);
  EXPECT_EQ(goal.points[0].velocities, point.velocities);
  EXPECT_EQ(goal.points[0].accelerations, point.accelerations);
  EXPECT_EQ(goal.points[0].efforts, point.effort);
  EXPECT_DOUBLE_EQ(goal.points[0].time.count(), -0.5);
  ASSERT_EQ(goal.path_tolerance.size(), 1U);
  EXPECT_EQ(goal.path_tolerance[0].joint, "joint1");
  EXPECT_EQ(goal.path_tolerance[0].position, 0.1);
  ASSERT_EQ(goal.goal_tolerance.size(), 2U);
  EXPECT_EQ(goal.goal_tolerance[1].velocity, -1.0);
  EXPECT_EQ(goal.goal_time_tolerance, 0.25);
}

TEST_F(MessageConversion, StateLeavesActualAndErrorAccelerationsEmpty) {
  control_msgs::JointTrajectoryControllerState message;
  fill_state(snapshot(), message);
  EXPECT_EQ(message.desired.accelerations, (std::vector<double>{3.0, 3.0}));
  EXPECT_EQ(message.error.positions, (std::vector<double>{0.25, 0.25}));
  EXPECT_EQ(message.error.velocities, (std::vector<double>{0.5, 0.5}));
  EXPECT_TRUE(message.actual.accelerations.empty());
  EXPECT_TRUE(message.error.accelerations.empty());
  EXPECT_EQ(message.header.frame_id, "");
  EXPECT_DOUBLE_EQ(message.desired.time_from_start.toSec(), 1.25);
}

TEST_F(MessageConversion, AJointThatDoesNotAnswerHasNoJointState) {
  auto silent = snapshot();
  silent.joints[0].online = false;
  sensor_msgs::JointState message;
  fill_joint_state(silent, message);
  EXPECT_EQ(message.name, std::vector<std::string>{"joint2"});
  EXPECT_EQ(message.position, std::vector<double>{0.75});
  EXPECT_TRUE(message.effort.empty());
}

TEST_F(MessageConversion, AnEmptyBufferAtRestIsNoWarning) {
  interpolated_motion_driver::BufferStatus message;
  motion::Snapshot drives = snapshot();
  drives.joints[1].warnings.underflow = true;
  drives.state = motion::GroupState::Idle;
  fill_buffer_status(drives, message);
  EXPECT_EQ(message.underflow_warning, (std::vector<std::uint8_t>{0, 0}));
  for (const auto state : {motion::GroupState::Moving, motion::GroupState::Streaming}) {
    drives.state = state;
    fill_buffer_status(drives, message);
    EXPECT_EQ(message.underflow_warning, (std::vector<std::uint8_t>{0, 1}));
  }
}

TEST_F(MessageConversion, BufferStatusHasTheLoadOfTheJointsBus) {
  interpolated_motion_driver::BufferStatus message;
  fill_buffer_status(snapshot(), message);
  EXPECT_EQ(message.bus_load, (std::vector<double>{0.125, 0.125}));
}

TEST_F(MessageConversion, UnitsAreThoseOfTheJoints) {
  auto mixed = snapshot();
  mixed.joints[1].unit = trajectory::JointUnit::Metre;
  interpolated_motion_driver::DriveState message;
  fill_drive_states(mixed, message);
  EXPECT_EQ(message.unit, (std::vector<std::string>{"rad", "m"}));
  motion::MotionReport report;
  report.joints.resize(1);
  report.joints[0].unit = trajectory::JointUnit::Metre;
  report.joints[0].count = 2.5e-6;
  interpolated_motion_driver::GetMotionReport::Response response;
  fill_motion_report(report, response);
  EXPECT_EQ(response.unit.at(0), "m");
  EXPECT_EQ(response.count.at(0), 2.5e-6);
}

TEST_F(MessageConversion, DeviationsOfARealDriveAreUnknown) {
  motion::MotionReport report;
  report.valid = true;
  report.joints.resize(1);
  interpolated_motion_driver::GetMotionReport::Response response;
  fill_motion_report(report, response);
  EXPECT_TRUE(std::isnan(response.worst_deviation.at(0)));
  EXPECT_TRUE(std::isnan(response.final_deviation.at(0)));
}

TEST_F(MessageConversion, OnlyAnAbortedGoalHasAnErrorCode) {
  EXPECT_EQ(to_result({1, motion::GoalOutcome::Succeeded, GoalError::InvalidGoal, ""}).error_code, 0);
  EXPECT_EQ(to_result({1, motion::GoalOutcome::Preempted, GoalError::InvalidGoal, "stopped"}).error_code, 0);
  const auto aborted = to_result({1, motion::GoalOutcome::Aborted, GoalError::PathToleranceViolated, "why"});
  EXPECT_EQ(aborted.error_code, -4);
  EXPECT_EQ(aborted.error_string, "why");
}

}  // namespace
}  // namespace interpolated_motion::node
