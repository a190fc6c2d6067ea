#include <string>

#include <gtest/gtest.h>
#include <ros/message_traits.h>
#include <ros/service_traits.h>

#include <control_msgs/FollowJointTrajectoryAction.h>
#include <control_msgs/GripperCommand.h>
#include <control_msgs/JointControllerState.h>
#include <control_msgs/JointJog.h>
#include <control_msgs/JointTolerance.h>
#include <control_msgs/JointTrajectoryAction.h>
#include <control_msgs/JointTrajectoryControllerState.h>
#include <control_msgs/PidState.h>
#include <control_msgs/QueryCalibrationState.h>
#include <control_msgs/QueryTrajectoryState.h>
#include <control_msgs/SingleJointPositionAction.h>

// Two ROS nodes talk to each other only if name and md5 sum of a type are equal on both sides. The sums are
// those that ROS's control_msgs 1.5.2 has, whichever control_msgs this package was built with.
namespace {

template <typename Message>
void expect_type(const std::string& name, const std::string& md5) {
  EXPECT_EQ(ros::message_traits::datatype<Message>(), "control_msgs/" + name);
  EXPECT_EQ(ros::message_traits::md5sum<Message>(), md5) << name;
}

template <typename Service>
void expect_service(const std::string& name, const std::string& md5) {
  EXPECT_EQ(ros::service_traits::datatype<Service>(), "control_msgs/" + name);
  EXPECT_EQ(ros::service_traits::md5sum<Service>(), md5) << name;
}

TEST(ControlMsgs, FollowJointTrajectoryHasTheSumsOfRos) {
  expect_type<control_msgs::FollowJointTrajectoryAction>("FollowJointTrajectoryAction",
                                                         "bc4f9b743838566551c0390c65f1a248");
  expect_type<control_msgs::FollowJointTrajectoryActionGoal>("FollowJointTrajectoryActionGoal",
                                                             "cff5c1d533bf2f82dd0138d57f4304bb");
  expect_type<control_msgs::FollowJointTrajectoryActionResult>("FollowJointTrajectoryActionResult",
                                                               "c4fb3b000dc9da4fd99699380efcc5d9");
  expect_type<control_msgs::FollowJointTrajectoryActionFeedback>("FollowJointTrajectoryActionFeedback",
                                                                 "d8920dc4eae9fc107e00999cce4be641");
  expect_type<control_msgs::FollowJointTrajectoryGoal>("FollowJointTrajectoryGoal",
                                                       "69636787b6ecbde4d61d711979bc7ecb");
  expect_type<control_msgs::FollowJointTrajectoryResult>("FollowJointTrajectoryResult",
                                                         "493383b18409bfb604b4e26c676401d2");
  expect_type<control_msgs::FollowJointTrajectoryFeedback>("FollowJointTrajectoryFeedback",
                                                           "10817c60c2486ef6b33e97dcd87f4474");
}

TEST(ControlMsgs, JointTrajectoryActionHasTheSumsOfRos) {
  expect_type<control_msgs::JointTrajectoryAction>("JointTrajectoryAction",
                                                   "a04ba3ee8f6a2d0985a6aeaf23d9d7ad");
  expect_type<control_msgs::JointTrajectoryActionGoal>("JointTrajectoryActionGoal",
                                                       "a99e83ef6185f9fdd7693efe99623a86");
  expect_type<control_msgs::JointTrajectoryActionResult>("JointTrajectoryActionResult",
                                                         "1eb06eeff08fa7ea874431638cb52332");
  expect_type<control_msgs::JointTrajectoryActionFeedback>("JointTrajectoryActionFeedback",
                                                           "aae20e09065c3809e8a8e87c4c8953fd");
  expect_type<control_msgs::JointTrajectoryGoal>("JointTrajectoryGoal", "2a0eff76c870e8595636c2a562ca298e");
  expect_type<control_msgs::JointTrajectoryResult>("JointTrajectoryResult",
                                                   "d41d8cd98f00b204e9800998ecf8427e");
  expect_type<control_msgs::JointTrajectoryFeedback>("JointTrajectoryFeedback",
                                                     "d41d8cd98f00b204e9800998ecf8427e");
}

TEST(ControlMsgs, SingleJointPositionHasTheSumsOfRos) {
  expect_type<control_msgs::SingleJointPositionAction>("SingleJointPositionAction",
                                                       "c4a786b7d53e5d0983decf967a5a779e");
  expect_type<control_msgs::SingleJointPositionGoal>("SingleJointPositionGoal",
                                                     "fbaaa562a23a013fd5053e5f72cbb35c");
  expect_type<control_msgs::SingleJointPositionFeedback>("SingleJointPositionFeedback",
                                                         "8cee65610a3d08e0a1bded82f146f1fd");
}

TEST(ControlMsgs, MessagesHaveTheSumsOfRos) {
  expect_type<control_msgs::JointTolerance>("JointTolerance", "f544fe9c16cf04547e135dd6063ff5be");
  expect_type<control_msgs::JointTrajectoryControllerState>("JointTrajectoryControllerState",
                                                            "10817c60c2486ef6b33e97dcd87f4474");
  expect_type<control_msgs::JointControllerState>("JointControllerState", "987ad85e4756f3aef7f1e5e7fe0595d1");
  expect_type<control_msgs::PidState>("PidState", "b138ec00e886c10e73f27e8712252ea6");
  expect_type<control_msgs::JointJog>("JointJog", "1685da700c8c2e1254afc92a5fb89c96");
  expect_type<control_msgs::GripperCommand>("GripperCommand", "680acaff79486f017132a7f198d40f08");
}

TEST(ControlMsgs, ServicesHaveTheSumsOfRos) {
  expect_service<control_msgs::QueryTrajectoryState>("QueryTrajectoryState",
                                                     "ec93cdecbd8062d761aa52b7c90cd44b");
  expect_service<control_msgs::QueryCalibrationState>("QueryCalibrationState",
                                                      "28af3beedcb84986b8e470dc5470507d");
  EXPECT_STREQ(ros::message_traits::md5sum<control_msgs::QueryTrajectoryStateRequest>(),
               "556a4fb76023a469987922359d08a844");
  EXPECT_STREQ(ros::message_traits::md5sum<control_msgs::QueryTrajectoryStateResponse>(),
               "1f1a6554ad060f44d013e71868403c1a");
}

TEST(ControlMsgs, ConstantsOfTheResultAreThoseOfRos) {
  using Result = control_msgs::FollowJointTrajectoryResult;
  EXPECT_EQ(Result::SUCCESSFUL + 0, 0);
  EXPECT_EQ(Result::INVALID_GOAL + 0, -1);
  EXPECT_EQ(Result::INVALID_JOINTS + 0, -2);
  EXPECT_EQ(Result::OLD_HEADER_TIMESTAMP + 0, -3);
  EXPECT_EQ(Result::PATH_TOLERANCE_VIOLATED + 0, -4);
  EXPECT_EQ(Result::GOAL_TOLERANCE_VIOLATED + 0, -5);
}

}  // namespace
