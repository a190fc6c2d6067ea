#include "interpolated_motion_driver/node/link_frames.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace interpolated_motion::node {
namespace {

constexpr double kQuarter = 3.14159265358979324 / 2.0;  // of a turn, rad

const std::string kUrdf = R"(<robot name="r">
  <link name="base"/><link name="arm"/><link name="slide"/><link name="tool"/><link name="finger"/><link name="cart"/>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 2"/>
    <origin xyz="1 0 0"/><limit lower="-2" upper="2" velocity="3" effort="1"/></joint>
  <joint name="rail" type="prismatic"><parent link="arm"/><child link="slide"/><axis xyz="0 1 0"/>
    <origin xyz="0 0 1" rpy="0 0 1.57079632679489662"/><limit lower="0" upper="2" velocity="3" effort="1"/></joint>
  <joint name="glue" type="fixed"><parent link="slide"/><child link="tool"/><origin xyz="0 0 0.5"/></joint>
  <joint name="grip" type="revolute"><parent link="tool"/><child link="finger"/><axis xyz="0 0 1"/>
    <mimic joint="hinge" multiplier="-2" offset="0.25"/><limit lower="-9" upper="9" velocity="3" effort="1"/></joint>
  <joint name="caster" type="continuous"><parent link="base"/><child link="cart"/><axis xyz="0 0 1"/></joint>
</robot>)";

LinkFrames frames() { return LinkFrames({kUrdf, "the test's URDF"}, {"rail", "hinge"}); }

/// The link `child`; fails the test when it is missing.
LinkFrames::Frame frame_of(const std::vector<LinkFrames::Frame>& frames, const std::string& child) {
  for (const auto& frame : frames) {
    if (frame.child == child) return frame;
  }
  ADD_FAILURE() << child << " is missing";
  return {};
}

void expect_at(const tf2::Vector3& point, double x, double y, double z) {
  EXPECT_NEAR(point.x(), x, 1e-12);
  EXPECT_NEAR(point.y(), y, 1e-12);
  EXPECT_NEAR(point.z(), z, 1e-12);
}

TEST(LinkFrames, StartAtTheLinkThatIsNoChild) { EXPECT_EQ(frames().root(), "base"); }

TEST(LinkFrames, ARevoluteJointTurnsAboutItsAxis) {
  const auto arm = frame_of(frames().moved({0.0, kQuarter}), "arm");
  EXPECT_EQ(arm.parent, "base");
  expect_at(arm.transform.getOrigin(), 1.0, 0.0, 0.0);
  expect_at(arm.transform * tf2::Vector3(1.0, 0.0, 0.0), 1.0, 1.0, 0.0);
}

TEST(LinkFrames, APrismaticJointMovesAlongItsAxisAsItsOriginTurnsIt) {
  const auto slide = frame_of(frames().moved({0.75, 0.0}), "slide");
  EXPECT_EQ(slide.parent, "arm");
  expect_at(slide.transform.getOrigin(), -0.75, 0.0, 1.0);
}

TEST(LinkFrames, AJointThatMimicsFollowsTheOneItNames) {
  const auto finger = frame_of(frames().moved({0.0, 0.5}), "finger");
  const double angle = -2.0 * 0.5 + 0.25;
  expect_at(finger.transform * tf2::Vector3(1.0, 0.0, 0.0), std::cos(angle), std::sin(angle), 0.0);
}

TEST(LinkFrames, FixedLinksAreKeptApart) {
  const LinkFrames all = frames();
  ASSERT_EQ(all.fixed().size(), 1U);
  EXPECT_EQ(all.fixed()[0].child, "tool");
  expect_at(all.fixed()[0].transform.getOrigin(), 0.0, 0.0, 0.5);
}

TEST(LinkFrames, WhatOthersMoveOrNobodyKnowsIsLeftOut) {
  EXPECT_EQ(frames().moved({0.0, 0.0}).size(), 3U) << "not the caster";
  const auto known = frames().moved({0.0, std::numeric_limits<double>::quiet_NaN()});
  ASSERT_EQ(known.size(), 1U) << "neither the hinge nor what mimics it";
  EXPECT_EQ(known[0].child, "slide");
}

}  // namespace
}  // namespace interpolated_motion::node
