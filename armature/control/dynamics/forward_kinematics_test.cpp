// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/forward_kinematics.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

/// Two links of 0.6 m and 0.4 m that turn about z, a slide along z, and a hand turned by 90 degrees
/// about x at its end.
constexpr const char* kArm = R"(<robot name="arm"><link name="base"/>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
    <axis xyz="0 0 1"/><origin xyz="0 0 0.3"/></joint>
  <link name="upper"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0"
    iyz="0"/></inertial></link>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
    <axis xyz="0 0 1"/><origin xyz="0.6 0 0"/></joint>
  <link name="lower"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0"
    iyz="0"/></inertial></link>
  <joint name="lift" type="prismatic"><parent link="lower"/><child link="quill"/>
    <axis xyz="0 0 1"/><origin xyz="0.4 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <link name="quill"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0"
    iyz="0"/></inertial></link>
  <joint name="wrist" type="fixed"><parent link="quill"/><child link="hand"/>
    <origin xyz="0 0 -0.1" rpy="1.5707963267948966 0 0"/></joint>
  <link name="hand"/></robot>)";

ForwardKinematics make(const ForwardKinematics::Config& config) {
  base::Diagnostics diagnostics;
  auto made = ForwardKinematics::parse(kArm, "arm.urdf", config, diagnostics);
  EXPECT_TRUE(made.has_value()) << diagnostics.to_text();
  return std::move(made.value());
}

TEST(ForwardKinematics, OfAScaraArmIsThatOfTheTextbook) {
  auto kinematics = make({});
  Pose pose;
  const double q1 = 0.4, q2 = -1.1, q3 = 0.25;
  ASSERT_TRUE(kinematics.step(std::vector<double>{q1, q2, q3}, pose));
  const double x = 0.6 * std::cos(q1) + 0.4 * std::cos(q1 + q2);
  const double y = 0.6 * std::sin(q1) + 0.4 * std::sin(q1 + q2);
  EXPECT_THAT(pose.position, Pointwise(DoubleNear(1e-15), {x, y, 0.3 + q3}));
  const double c = std::cos(q1 + q2), s = std::sin(q1 + q2);
  EXPECT_THAT(pose.rotation, Pointwise(DoubleNear(1e-15), {c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0}));
}

TEST(ForwardKinematics, TheTipMayBeFixedToTheLastLink) {
  auto kinematics = make({.tip_link = "hand"});
  Pose pose;
  ASSERT_TRUE(kinematics.step(std::vector<double>{0.0, 0.0, 0.2}, pose));
  EXPECT_THAT(pose.position, Pointwise(DoubleNear(1e-15), {1.0, 0.0, 0.4}));
  EXPECT_THAT(pose.rotation,
              Pointwise(DoubleNear(1e-15), {1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0}));
}

TEST(ForwardKinematics, APoseIsInTheAxesOfTheBaseLink) {
  auto kinematics = make({.base_link = "upper"});
  Pose pose;
  ASSERT_EQ(kinematics.joints(), 2u);
  ASSERT_TRUE(kinematics.step(std::vector<double>{M_PI_2, 0.1}, pose));
  EXPECT_THAT(pose.position, Pointwise(DoubleNear(1e-15), {0.6, 0.4, 0.1}));
}

TEST(ForwardKinematics, AnotherNumberOfPositionsIsRefused) {
  auto kinematics = make({});
  Pose pose;
  EXPECT_FALSE(kinematics.step(std::vector<double>(2), pose));
  EXPECT_THAT(pose.position, Pointwise(DoubleNear(0.0), {0.0, 0.0, 0.0}));
}

TEST(ForwardKinematics, AFileThatCannotBeReadIsNamed) {
  base::Diagnostics diagnostics;
  EXPECT_FALSE(ForwardKinematics::load("/nowhere/arm.urdf", {}, diagnostics));
  EXPECT_EQ(diagnostics.to_text(),
            "/nowhere/arm.urdf: error: cannot be read, expected the description of a robot (URDF) "
            "(give the path of a file that exists)\n");
}

}  // namespace
}  // namespace armature::control
