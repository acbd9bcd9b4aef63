// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/robot_frames.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/dynamics/forward_kinematics.hpp"

namespace armature::control {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string text_of(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The pose of a link in the root's axes, joint by joint.
FramePose pose_of(const RobotFrames& robot, const std::string& link,
                  const std::vector<std::size_t>& moving, const std::vector<double>& positions) {
  FramePose pose;
  for (std::string at = link;;) {
    const auto& all = robot.joints();
    const auto joint = std::ranges::find(all, at, &RobotFrames::Joint::child);
    if (joint == all.end()) return pose;
    const auto number = static_cast<std::size_t>(joint - all.begin());
    const auto place = std::ranges::find(moving, number);
    const double position =
        place == moving.end() ? 0.0 : positions[static_cast<std::size_t>(place - moving.begin())];
    pose = combined(robot.pose(number, position), pose);
    at = joint->parent;
  }
}

TEST(RobotFramesTest, PosesOfTheWamAreThoseOfItsForwardKinematics) {
  const std::string text = text_of(WAM7);
  const auto robot = RobotFrames::parse(text);
  ASSERT_TRUE(robot.ok()) << robot.error();
  const auto moving = robot.value().moving("", "");
  ASSERT_EQ(moving.size(), 7u);
  base::Diagnostics diagnostics;
  const std::string tip = robot.value().joints()[moving.back()].child;
  auto kinematics = ForwardKinematics::parse(text, "wam7.urdf", {"", tip}, diagnostics);
  ASSERT_TRUE(kinematics);
  const std::vector<double> positions{0.3, -0.5, 0.7, 1.1, -0.2, 0.4, 0.9};
  Pose expected;
  ASSERT_TRUE(kinematics->step(positions, expected));
  const FramePose found = pose_of(robot.value(), tip, moving, positions);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.position[i], expected.position[i], 1e-12);
    std::array<double, 3> axis{};
    axis[i] = 1.0;
    const FramePose end = combined(found, {axis, {0, 0, 0, 1}});
    for (std::size_t row = 0; row < 3; ++row) {
      EXPECT_NEAR(end.position[row] - found.position[row], expected.rotation[3 * row + i], 1e-12);
    }
  }
}

constexpr const char* kCart = R"(<?xml version="1.0"?>
<robot name="cart">
  <material name="red"><color rgba="1 0 0 0.5"/></material>
  <link name="rail"/>
  <link name="carriage">
    <visual><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.1" length="0.4"/></geometry><material name="red"/></visual>
    <visual><geometry><sphere radius="0.2"/></geometry></visual>
    <visual><geometry><mesh filename="carriage.stl"/></geometry></visual>
  </link>
  <link name="tool"/>
  <joint name="slide" type="prismatic"><parent link="rail"/><child link="carriage"/><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><axis xyz="2 0 0"/></joint>
  <joint name="mount" type="fixed"><parent link="carriage"/><child link="tool"/></joint>
</robot>)";

TEST(RobotFramesTest, WhatSlidesMovesAlongItsOwnAxis) {
  const auto cart = RobotFrames::parse(kCart);
  ASSERT_TRUE(cart.ok()) << cart.error();
  EXPECT_THAT(cart.value().moving("", ""), ElementsAre(0u));
  const FramePose pose = cart.value().pose(0, 0.5);
  EXPECT_NEAR(pose.position[0], 0.0, 1e-12);
  EXPECT_NEAR(pose.position[1], 0.5, 1e-12);
  EXPECT_NEAR(pose.position[2], 1.0, 1e-12);
  EXPECT_NEAR(pose.rotation[2], std::numbers::sqrt2 / 2.0, 1e-12);
}

TEST(RobotFramesTest, LinksHaveTheirShapesAndThoseWithoutHaveBones) {
  const auto cart = RobotFrames::parse(kCart).value();
  ASSERT_EQ(cart.shapes().size(), 3u);
  EXPECT_EQ(cart.shapes()[0].kind, LinkShape::Kind::kCylinder);
  EXPECT_THAT(cart.shapes()[0].size, ElementsAre(0.2, 0.2, 0.4));
  EXPECT_THAT(cart.shapes()[0].colour, ElementsAre(1.0, 0.0, 0.0, 0.5));
  EXPECT_EQ(cart.shapes()[1].kind, LinkShape::Kind::kSphere);
  EXPECT_EQ(cart.shapes()[2].link, "rail");
  EXPECT_THAT(cart.shapes()[2].pose.position, ElementsAre(0.0, 0.0, 0.5));
  EXPECT_DOUBLE_EQ(cart.shapes()[2].size[2], 1.0);
}

TEST(RobotFramesTest, WhatIsNoDescriptionIsRefusedAndSaysWhy) {
  EXPECT_THAT(RobotFrames::parse("<robot").error(), HasSubstr("found no XML"));
  EXPECT_THAT(RobotFrames::parse("<world/>").error(), HasSubstr("found <world>"));
  EXPECT_THAT(RobotFrames::parse("<robot><link name='a'/><joint name='j'><parent link='a'/><child "
                                 "link='b'/></joint></robot>")
                  .error(),
              HasSubstr("'j' is at the link 'b'"));
}

}  // namespace
}  // namespace armature::control
