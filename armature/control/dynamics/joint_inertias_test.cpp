// SPDX-License-Identifier: Apache-2.0
#include "armature/control/dynamics/joint_inertias.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

/// Two rods in the plane of gravity, each a point of 2 kg at 0.5 m; joints turn about y.
constexpr const char* kTwoRods = R"(
<robot name="rods">
  <link name="base"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-3.2" upper="3.2" effort="60" velocity="2"/>
  </joint>
  <link name="upper"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="fore"/><origin xyz="0.5 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="20" velocity="3"/>
  </joint>
  <link name="fore"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
    <inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>)";

InverseDynamics two_rods() {
  base::Diagnostics diagnostics;
  return std::move(*InverseDynamics::parse(kTwoRods, "rods", {}, diagnostics));
}

// Of the shoulder: 2 0.5^2 + 2 (0.5^2 + 0.5^2 + 2 0.5 0.5 cos(elbow)).
TEST(JointInertias, AreThoseOfTheStretchedAndTheFoldedArm) {
  InverseDynamics links = two_rods();
  const auto ranges = find_joint_ranges(links, nullptr, {{-3.2, -3.0}, {3.2, 3.0}});
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_NEAR(ranges[0].most_inertia, 2.5, 0.01);
  EXPECT_NEAR(ranges[1].most_inertia, 0.5, 1e-9);
  // 1 / (M^-1)_ii = det / M_jj; det = 1.5 0.5 ... - 0.5^2 (1 + cos)^2, smallest at cos = +-1
  const auto det = [](double c) { return (1.5 + c) * 0.5 - 0.25 * (1.0 + c) * (1.0 + c); };
  EXPECT_NEAR(ranges[0].least_inertia, det(-0.99) / 0.5, 0.01);
  EXPECT_NEAR(ranges[1].least_inertia, det(1.0) / 2.5, 0.01);
}

TEST(JointInertias, ComeWithTheLimitsOfTheDescription) {
  const InverseDynamics links = two_rods();
  ASSERT_EQ(links.limits().size(), 2U);
  EXPECT_EQ(links.limits()[1].lower, -3.0);
  EXPECT_EQ(links.limits()[1].upper, 3.0);
  EXPECT_EQ(links.limits()[1].max_velocity, 3.0);
  EXPECT_EQ(links.limits()[0].max_effort, 60.0);
}

TEST(JointInertias, HaveTheLargestWeight) {
  InverseDynamics links = two_rods();
  const auto ranges = find_joint_ranges(links, nullptr, {{-3.2, -3.0}, {3.2, 3.0}});
  EXPECT_NEAR(ranges[0].most_weight, 9.81 * (2.0 * 0.5 + 2.0 * 1.0), 0.3);
  EXPECT_NEAR(ranges[1].most_weight, 9.81 * 2.0 * 0.5, 0.1);
}

TEST(JointInertias, HaveTheRotors) {
  InverseDynamics links = two_rods();
  const auto rotors = Transmission::make({.turns = {100.0, 50.0}, .rotor_inertia = {1e-4, 2e-4}});
  const auto without = find_joint_ranges(links, nullptr, {{-3.2, -3.0}, {3.2, 3.0}});
  const auto with = find_joint_ranges(links, &rotors.value(), {{-3.2, -3.0}, {3.2, 3.0}});
  EXPECT_NEAR(with[0].most_inertia - without[0].most_inertia, 1.0, 1e-9);
  EXPECT_NEAR(with[1].most_inertia - without[1].most_inertia, 0.5, 1e-9);
  EXPECT_GT(with[0].least_inertia, without[0].least_inertia + 1.0);
}

TEST(JointInertias, AreTheSameEveryTime) {
  InverseDynamics links = two_rods();
  const auto once = find_joint_ranges(links, nullptr, {{-1.0, -3.0}, {3.2, 0.5}});
  const auto again = find_joint_ranges(links, nullptr, {{-1.0, -3.0}, {3.2, 0.5}});
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].least_inertia, again[i].least_inertia);
    EXPECT_EQ(once[i].most_inertia, again[i].most_inertia);
    EXPECT_EQ(once[i].most_weight, again[i].most_weight);
  }
}

}  // namespace
}  // namespace armature::control
