// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/forward_kinematics/forward_kinematics.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"
#include "armature/testing/realtime_guard.hpp"

namespace armature::controllers {
namespace {

using ::testing::HasSubstr;

using Vector = std::vector<double>;

class ForwardKinematicsTest : public ::testing::Test {
 protected:
  ForwardKinematicsTest() {
    tool.set("joints", 2);
    tool.set("robot_description", std::string_view(TESTDATA "/two_links.urdf"));
    tool.set("tip_link", std::string_view("hand"));
  }
  const Pose& pose_at(double shoulder, double elbow) {
    tool.write("nAxesSensorPosition", Vector{shoulder, elbow});
    return tool.output<Pose>("pose");
  }

  testing::Harness tool{std::make_unique<ForwardKinematics>("Tool")};
};

TEST_F(ForwardKinematicsTest, TellsPositionAndOrientationOfTheTip) {
  ASSERT_TRUE(tool.start()) << tool.reason();
  const double shoulder = 0.4, elbow = -1.1, both = shoulder + elbow;
  const Pose& pose = pose_at(shoulder, elbow);
  EXPECT_NEAR(pose.position.x, 0.6 * std::cos(shoulder) + 0.4 * std::cos(both), 1e-12);
  EXPECT_NEAR(pose.position.y, 0.6 * std::sin(shoulder) + 0.4 * std::sin(both), 1e-12);
  EXPECT_NEAR(pose.position.z, 0.3, 1e-12);
  // A turn about z after a quarter about x.
  const double quarter = std::sqrt(0.5);
  EXPECT_NEAR(pose.orientation.x, std::cos(both / 2) * quarter, 1e-12);
  EXPECT_NEAR(pose.orientation.y, std::sin(both / 2) * quarter, 1e-12);
  EXPECT_NEAR(pose.orientation.z, std::sin(both / 2) * quarter, 1e-12);
  EXPECT_NEAR(pose.orientation.w, std::cos(both / 2) * quarter, 1e-12);
}

TEST_F(ForwardKinematicsTest, TheOrientationNeverJumpsToItsNegative) {
  ASSERT_TRUE(tool.start()) << tool.reason();
  Quaternion last = pose_at(0.0, 0.0).orientation;
  for (double angle = 0.0; angle < 13.0; angle += 0.05) {
    const Quaternion next = pose_at(angle, 0.0).orientation;
    EXPECT_NEAR(
        std::hypot(next.x - last.x, next.y - last.y, std::hypot(next.z - last.z, next.w - last.w)),
        0.025, 0.026)
        << angle;
    last = next;
  }
}

TEST_F(ForwardKinematicsTest, APoseIsInTheAxesOfTheBaseLink) {
  tool.set("joints", 1);
  tool.set("base_link", std::string_view("upper"));
  ASSERT_TRUE(tool.start()) << tool.reason();
  tool.write("nAxesSensorPosition", Vector{0.0});
  EXPECT_NEAR(tool.output<Pose>("pose").position.x, 1.0, 1e-12);
  EXPECT_NEAR(tool.output<Pose>("pose").position.z, 0.0, 1e-12);
}

TEST_F(ForwardKinematicsTest, RefusesWhatIsNotTheRobot) {
  tool.set("joints", 3);
  EXPECT_FALSE(tool.start());
  EXPECT_THAT(tool.reason(), HasSubstr("two_links.urdf moves 2 joints up to its tip, expected "
                                       "joints = 3"));
  tool.set("joints", 2);
  tool.set("tip_link", std::string_view("hnd"));
  EXPECT_FALSE(tool.start());
  EXPECT_THAT(tool.reason(), HasSubstr("unknown link 'hnd' in robot 'two_links'"));
  tool.set("robot_description", std::string_view("nowhere.urdf"));
  EXPECT_FALSE(tool.start());
  EXPECT_THAT(tool.reason(), HasSubstr("nowhere.urdf: cannot be read"));
}

TEST_F(ForwardKinematicsTest, FaultsForAPositionThatIsNoNumber) {
  ASSERT_TRUE(tool.start()) << tool.reason();
  tool.write("nAxesSensorPosition", Vector{0.1, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(tool.state(), component::State::kException);
  EXPECT_EQ(tool.reason(), "the position of joint 2 is nan, expected a finite number");
  EXPECT_EQ(tool.writes("pose"), 0u);
}

TEST_F(ForwardKinematicsTest, BreaksNoRuleOfRealTime) {
  ASSERT_TRUE(tool.start()) << tool.reason();
  pose_at(0.0, 0.0);
  const testing::RealtimeGuard guard;
  for (int i = 0; i < 100; ++i) pose_at(0.01 * i, 0.02 * i);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

}  // namespace
}  // namespace armature::controllers
