// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/inverse_kinematics.hpp"

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/cartesian/pose_path.hpp"

namespace armature::control {
namespace {

InverseKinematics wam() {
  base::Diagnostics diagnostics;
  auto arm = InverseKinematics::load(WAM7, {.base_link = {}, .tip_link = "tool"}, diagnostics);
  EXPECT_TRUE(arm) << diagnostics.to_text();
  return std::move(*arm);
}

TEST(InverseKinematics, FindsTheJointsOfAPoseNearby) {
  InverseKinematics arm = wam();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  std::uniform_real_distribution<double> nearby(-0.2, 0.2);
  for (int k = 0; k < 500; ++k) {
    std::vector<double> there(7);
    for (double& joint : there) joint = anywhere(random);
    there[3] += 1.5;
    std::vector<double> joints = there;
    for (double& joint : joints) joint += nearby(random);
    const Pose pose = arm.pose_at(there);
    ASSERT_LT(arm.solve(pose, joints), 1e-8) << k;
    const PoseDistance apart = distance(arm.pose_at(joints), pose);
    ASSERT_LT(apart.way, 1e-8);
    ASSERT_LT(apart.angle, 1e-6) << "of rotations in twice nine digits";
  }
}

TEST(InverseKinematics, TellsWhatIsLeftOfAPoseOutOfReach) {
  InverseKinematics arm = wam();
  std::vector<double> joints{0, 0.5, 0, 1.0, 0, 0, 0};
  EXPECT_GT(arm.solve(pose_of({2.0, 0, 0, 0, 0, 0}), joints), 0.5);
  for (const double joint : joints) EXPECT_TRUE(std::isfinite(joint));
}

TEST(InverseKinematics, IsThePoseThatForwardKinematicsFinds) {
  base::Diagnostics diagnostics;
  auto forward = ForwardKinematics::load(WAM7, {.base_link = {}, .tip_link = "tool"}, diagnostics);
  ASSERT_TRUE(forward);
  InverseKinematics arm = wam();
  const std::vector<double> joints{0.1, 0.5, -0.3, 1.0, 0.2, 0.4, -0.7};
  Pose pose;
  ASSERT_TRUE(forward->step(joints, pose));
  EXPECT_LT(distance(arm.pose_at(joints), pose).way, 1e-12);
}

}  // namespace
}  // namespace armature::control
