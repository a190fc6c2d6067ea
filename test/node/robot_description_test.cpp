#include "interpolated_motion_driver/node/robot_description.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace interpolated_motion::node {
namespace {

const std::string kUrdf = R"(<robot name="r">
  <link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="e"/><link name="f"/>
  <joint name="hinge" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
    <limit lower="-1.5" upper="2.5" velocity="3" effort="1"/></joint>
  <joint name="wheel" type="continuous"><parent link="b"/><child link="c"/><limit velocity="10" effort="1"/></joint>
  <joint name="glue" type="fixed"><parent link="c"/><child link="d"/></joint>
  <joint name="finger" type="revolute"><parent link="d"/><child link="e"/><mimic joint="hinge"/>
    <limit lower="-1" upper="1" velocity="3" effort="1"/></joint>
  <joint name="stuck" type="revolute"><parent link="e"/><child link="f"/>
    <limit lower="0" upper="0" velocity="3" effort="1"/></joint>
</robot>)";

/// What joint_limits() says against `joint`; empty if nothing.
std::string refusal(const std::string& joint, const std::string& urdf = kUrdf) {
  try {
    joint_limits({urdf, "the test's URDF"}, {joint});
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

TEST(RobotDescription, LimitsOfARevoluteJoint) {
  const auto limits = joint_limits({kUrdf, "test"}, {"hinge"}).at("hinge");
  EXPECT_EQ(limits.min_position, -1.5);
  EXPECT_EQ(limits.max_position, 2.5);
  EXPECT_EQ(limits.max_velocity, 3.0);
  EXPECT_FALSE(limits.continuous);
}

TEST(RobotDescription, APrismaticJointIsInMetres) {
  std::string urdf = kUrdf;
  urdf.replace(urdf.find("revolute"), std::string("revolute").size(), "prismatic");
  EXPECT_EQ(joint_limits({urdf, "test"}, {"hinge"}).at("hinge").unit, trajectory::JointUnit::Metre);
  EXPECT_EQ(joint_limits({urdf, "test"}, {"wheel"}).at("wheel").unit, trajectory::JointUnit::Radian);
  EXPECT_EQ(joint_limits({kUrdf, "test"}, {"hinge"}).at("hinge").unit, trajectory::JointUnit::Radian);
}

TEST(RobotDescription, AContinuousJointHasNoPositionLimits) {
  const auto limits = joint_limits({kUrdf, "test"}, {"wheel"}).at("wheel");
  EXPECT_TRUE(limits.continuous);
  EXPECT_EQ(limits.max_position, std::numeric_limits<double>::infinity());
  EXPECT_EQ(limits.max_velocity, 10.0);
}

TEST(RobotDescription, SaysWhyAJointCannotBeDriven) {
  expect_words(refusal("elbow"), {"elbow", "no joint", "the test's URDF"});
  expect_words(refusal("glue"), {"glue", "fixed"});
  expect_words(refusal("finger"), {"finger", "mimics hinge"});
  expect_words(refusal("stuck"), {"stuck", "position limits 0 to 0"});
}

TEST(RobotDescription, SaysWhenTheTextIsNoUrdf) {
  expect_words(refusal("hinge", "<robot"), {"the test's URDF", "no valid URDF"});
}

std::string one_joint(const std::string& inside) {
  return "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"hinge\" "
         "type=\"revolute\"><parent "
         "link=\"a\"/><child link=\"b\"/>" +
         inside + "</joint></robot>";
}

TEST(RobotDescription, SaysWhenTheTextIsXacro) {
  const std::string limit = R"(<limit lower="-1" upper="${pi}" velocity="3" effort="1"/>)";
  expect_words(refusal("hinge", one_joint(limit)), {"the test's URDF", "is xacro", "${", "run xacro first"});
  expect_words(refusal("hinge", "<robot name=\"r\"><xacro:include filename=\"arm.xacro\"/></robot>"),
               {"is xacro", "<xacro:", "run xacro first"});
}

TEST(RobotDescription, SoftLimitsTightenTheHardOnes) {
  const std::string hard = R"(<limit lower="-1.5" upper="2.5" velocity="3" effort="1"/>)";
  const auto soft = [&hard](const std::string& limits) {
    return joint_limits({one_joint(hard + "<safety_controller k_velocity=\"10\" " + limits + "/>"), "test"},
                        {"hinge"})
        .at("hinge");
  };
  const auto both = soft(R"(soft_lower_limit="-1.2" soft_upper_limit="2.2")");
  EXPECT_EQ(both.min_position, -1.2);
  EXPECT_EQ(both.max_position, 2.2);
  const auto wider = soft(R"(soft_lower_limit="-2" soft_upper_limit="3")");
  EXPECT_EQ(wider.min_position, -1.5);
  EXPECT_EQ(wider.max_position, 2.5);
  const auto none = soft("");
  EXPECT_EQ(none.min_position, -1.5);
  EXPECT_EQ(none.max_position, 2.5);
}

TEST(RobotDescription, AVelocityLimitOf0IsLeftToTheConfiguration) {
  const std::string urdf = one_joint(R"(<limit lower="-1" upper="1" velocity="0" effort="1"/>)");
  EXPECT_EQ(joint_limits({urdf, "test"}, {"hinge"}).at("hinge").max_velocity, 0.0);
  expect_words(refusal("hinge", one_joint(R"(<limit lower="-1" upper="1" velocity="-1" effort="1"/>)")),
               {"hinge", "velocity limit -1"});
}

TEST(RobotDescription, NamesTheFileThatCannotBeRead) {
  try {
    read_robot_description_file("/nowhere/robot.urdf");
    FAIL() << "read";
  } catch (const std::invalid_argument& error) {
    expect_words(error.what(), {"robot_description_file", "/nowhere/robot.urdf", "No such file"});
  }
}

TEST(RobotDescription, ReadsTheFilesOfThisPackage) {
  const auto six = read_robot_description_file(IMD_SOURCE_DIR "/config/urdf/six_axis.urdf");
  const auto limits = joint_limits(six, {"joint1", "joint6"});
  EXPECT_EQ(limits.at("joint6").max_velocity, 3.5);
  const auto rrbot = read_robot_description_file(IMD_SOURCE_DIR "/config/urdf/rrbot.urdf");
  EXPECT_TRUE(joint_limits(rrbot, {"joint2"}).at("joint2").continuous);
}

}  // namespace
}  // namespace interpolated_motion::node
