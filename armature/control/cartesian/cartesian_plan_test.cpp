// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/cartesian_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/control/taught/taught_motion.hpp"
#include "armature/control/taught/timed_path.hpp"

namespace armature::control {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Planned : public ::testing::Test {
 protected:
  Planned() {
    base::Diagnostics diagnostics;
    arm_ = InverseKinematics::load(WAM7, {.base_link = {}, .tip_link = "tool"}, diagnostics);
    for (const JointLimits& each : arm_->limits()) {
      limits_.lower.push_back(each.lower);
      limits_.upper.push_back(each.upper);
    }
  }
  /// From where the tool is, by so much.
  Pose moved(double x, double y, double z, double turn = 0.0) {
    PoseNumbers numbers = numbers_of(here());
    numbers[0] += x;
    numbers[1] += y;
    numbers[2] += z;
    numbers[5] += turn;
    return pose_of(numbers);
  }
  Pose here() { return arm_->pose_at(start_); }
  base::Result<CartesianPlan> plan(const PosePath& path) {
    return plan_cartesian(*arm_, path, start_, limits_);
  }

  std::optional<InverseKinematics> arm_;
  CartesianLimits limits_;
  std::vector<double> start_{0.2, -1.2, 0.3, 2.2, -0.5, 0.4, 0.5};
};

TEST_F(Planned, ALineIsFollowedByTheTool) {
  const auto path = PosePath::line(here(), moved(0.1, 0.2, 0.05, 0.3)).value();
  const auto planned = plan(path);
  ASSERT_TRUE(planned) << planned.error();
  EXPECT_LT(planned.value().largest_deviation, limits_.max_deviation);
  const TaughtMotion motion{.axes = 7, .points = planned.value().points};
  const double duration = motion.duration_s();
  const double speeding_up_s = planned.value().speed / TimedPath::kHardest;
  EXPECT_NEAR(duration / planned.value().speed + speeding_up_s, planned.value().duration_s, 0.1)
      << "the player speeds up before the tool moves, and slows down when it rests";
  double fastest = 0.0;
  Pose last = path.at(0.0);
  for (int k = 1; k <= 1000; ++k) {
    const Pose pose = arm_->pose_at(motion.positions_at(duration * k / 1000));
    // How far from the line, wherever on it.
    double off = 1.0;
    for (int i = 0; i <= 200; ++i) {
      off = std::min(off, distance(pose, path.at(path.length() * i / 200)).way);
    }
    ASSERT_LT(off, limits_.max_deviation + 0.5 * path.length() / 200) << k;
    fastest =
        std::max(fastest, distance(pose, last).way / (duration / planned.value().speed / 1000));
    last = pose;
  }
  EXPECT_LT(fastest, 1.02 * limits_.velocity);
  EXPECT_GT(fastest, 0.9 * limits_.velocity);
  EXPECT_LT(distance(last, moved(0.1, 0.2, 0.05, 0.3)).way, limits_.max_deviation) << "it arrives";
}

TEST_F(Planned, ManyWaysAreFollowedOrRefusedWithTheirPlace) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> far(-0.3, 0.3);
  int followed = 0;
  for (int k = 0; k < 40; ++k) {
    const auto path =
        PosePath::line(here(), moved(far(random), far(random), far(random), far(random)));
    ASSERT_TRUE(path) << path.error();
    const auto planned = plan(path.value());
    if (!planned) {
      EXPECT_THAT(planned.error(), HasSubstr(" m along the path of "));
      continue;
    }
    ++followed;
    EXPECT_LE(planned.value().largest_deviation, limits_.max_deviation);
    const TaughtMotion motion{.axes = 7, .points = planned.value().points};
    for (int i = 0; i <= 300; ++i) {
      const auto joints = motion.positions_at(motion.duration_s() * i / 300);
      for (std::size_t joint = 0; joint < 7; ++joint) {
        ASSERT_GE(joints[joint], limits_.lower[joint] - 1e-3);
        ASSERT_LE(joints[joint], limits_.upper[joint] + 1e-3);
      }
    }
  }
  EXPECT_GT(followed, 20);
  EXPECT_LT(followed, 40) << "some leave what the arm can reach";
}

TEST_F(Planned, ASlowTurnDecidesHowFastATurningToolIs) {
  limits_.turning = 0.2;
  const auto planned = plan(PosePath::line(here(), moved(0.05, 0, 0, 0.5)).value());
  ASSERT_TRUE(planned) << planned.error();
  EXPECT_GT(planned.value().duration_s, 0.5 / 0.2);
  EXPECT_LT(planned.value().duration_s, 1.3 * 0.5 / 0.2);
}

TEST_F(Planned, WhatIsOutOfReachIsRefusedWithThePlace) {
  EXPECT_THAT(plan(PosePath::line(here(), moved(0, 0, 1.5)).value()).error(),
              AllOf(HasSubstr(" m along the path of 1.500 m, at x "), HasSubstr("reach"),
                    Not(HasSubstr("singular"))));
  limits_.lower.assign(7, -10.0);  // so that no joint's limit comes first
  limits_.upper.assign(7, 10.0);
  PoseNumbers far = numbers_of(here());
  for (std::size_t i = 0; i < 3; ++i) far[i] *= 3.0;
  EXPECT_THAT(plan(PosePath::line(here(), pose_of(far)).value()).error(),
              AllOf(HasSubstr("reach"), Not(HasSubstr("singular"))));
}

TEST_F(Planned, AJointBeyondItsLimitIsRefusedWithThePlace) {
  limits_.lower[3] = 2.0;  // the elbow may hardly straighten
  const Pose base = here();
  PoseNumbers far = numbers_of(base);
  for (std::size_t i = 0; i < 3; ++i) far[i] *= 1.25;
  EXPECT_THAT(
      plan(PosePath::line(base, pose_of(far)).value()).error(),
      AllOf(HasSubstr(" m along the path of "), HasSubstr(", joint 4 (joint4) would be at "),
            HasSubstr(", expected 2.000 to 3.142")));
}

TEST_F(Planned, APathThroughASingularPlaceIsRefusedWithThePlace) {
  // Without its first joint the arm has six; joints 5 and 7 nearly turn about one axis.
  base::Diagnostics diagnostics;
  arm_ = InverseKinematics::load(WAM7, {.base_link = "link1", .tip_link = "tool"}, diagnostics);
  ASSERT_TRUE(arm_) << diagnostics.to_text();
  limits_.lower.assign(6, -10.0);
  limits_.upper.assign(6, 10.0);
  start_ = {0.7, 0.0, 1.7, 0.8, 0.02, 0.0};
  const auto planned = plan(PosePath::line(here(), moved(0, 0, 0, 0.5)).value());
  ASSERT_FALSE(planned);
  EXPECT_THAT(planned.error(),
              AllOf(HasSubstr(" m along the path of "), HasSubstr("the arm is singular: joint"),
                    HasSubstr(" mm of way"), Not(HasSubstr("reach"))));
}

TEST_F(Planned, APathThatBeginsElsewhereIsRefused) {
  const auto path = PosePath::line(moved(0.1, 0, 0), moved(0.2, 0, 0)).value();
  EXPECT_THAT(plan(path).error(),
              HasSubstr("does not begin where the tool is: it is 0.1000 m away"));
}

TEST_F(Planned, NumbersThatDoNotFitAreRefused) {
  limits_.lower.pop_back();
  EXPECT_THAT(plan(PosePath::line(here(), moved(0.1, 0, 0)).value()).error(),
              HasSubstr("for each of 7 joints"));
}

}  // namespace
}  // namespace armature::control
