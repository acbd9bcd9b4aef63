// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/pose_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::control {
namespace {

using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Pose at(double x, double y, double z, double roll = 0.0, double pitch = 0.0, double yaw = 0.0) {
  return pose_of({x, y, z, roll, pitch, yaw});
}
void expect_near(const Pose& left, const Pose& right, double tolerance = 1e-9) {
  const PoseDistance apart = distance(left, right);
  EXPECT_LT(apart.way, tolerance);
  EXPECT_LT(apart.angle, 1e-7 + tolerance);
}

TEST(PoseNumbers, AreWhatTheyWereMadeOf) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  for (int k = 0; k < 1000; ++k) {
    const PoseNumbers numbers{
        0.1 * k, -0.2, 0.3, 2.0 * angle(random), angle(random), 2.0 * angle(random)};
    const PoseNumbers again = numbers_of(pose_of(numbers));
    for (std::size_t i = 0; i < 6; ++i) ASSERT_NEAR(again[i], numbers[i], 1e-9);
  }
}

TEST(PoseNumbers, TurnAboutTheFixedAxes) {
  const Pose pose = at(0, 0, 0, kPi / 2, 0, kPi / 2);  // about x, then about the fixed z
  // The tool's z goes to -y by the roll, then to x by the yaw.
  EXPECT_NEAR(pose.rotation[2], 1.0, 1e-12);
  expect_near(pose_of(numbers_of(at(0, 0, 0, 0.3, kPi / 2, 0.5))), at(0, 0, 0, 0.3, kPi / 2, 0.5),
              1e-6);
}

TEST(PosePath, ALineIsEvenInPlaceAndTurn) {
  const auto path = PosePath::line(at(0, 0, 0), at(0.3, 0.4, 0, 0, 0, 1.0));
  ASSERT_TRUE(path) << path.error();
  EXPECT_NEAR(path.value().length(), 0.5, 1e-12);
  expect_near(path.value().at(0.25), at(0.15, 0.2, 0, 0, 0, 0.5));
  expect_near(path.value().at(-1.0), at(0, 0, 0));
  expect_near(path.value().at(9.0), at(0.3, 0.4, 0, 0, 0, 1.0));
}

TEST(PosePath, ATurnAloneHasAWay) {
  const auto path = PosePath::line(at(0.1, 0, 0), at(0.1, 0, 0, 0, 0, 1.5));
  ASSERT_TRUE(path) << path.error();
  EXPECT_NEAR(path.value().length(), 0.15, 1e-9);
  expect_near(path.value().at(0.1), at(0.1, 0, 0, 0, 0, 1.0));
}

TEST(PosePath, AnArcStaysOnItsCircle) {
  const auto path = PosePath::arc(at(1, 0, 0.5), {0, 1, 0.5}, at(-1, 0, 0.5, 0, 0, 1.0));
  ASSERT_TRUE(path) << path.error();
  EXPECT_NEAR(path.value().length(), kPi, 1e-9);
  for (int k = 0; k <= 100; ++k) {
    const Pose pose = path.value().at(path.value().length() * k / 100);
    ASSERT_NEAR(std::hypot(pose.position[0], pose.position[1]), 1.0, 1e-9);
    ASSERT_NEAR(pose.position[2], 0.5, 1e-12);
    ASSERT_GT(pose.position[1], -1e-9) << "by way of its middle";
  }
  expect_near(path.value().at(kPi / 2), at(0, 1, 0.5, 0, 0, 0.5));
}

TEST(PosePath, AnArcMayBeLongerThanHalfACircle) {
  const auto path = PosePath::arc(at(1, 0, 0), {-1, 0, 0}, at(0, -1, 0));
  ASSERT_TRUE(path) << path.error();
  EXPECT_NEAR(path.value().length(), 1.5 * kPi, 1e-9);
  expect_near(path.value().at(0.5 * kPi), at(0, 1, 0));
}

TEST(PosePath, CornersAreRoundedWithinTheBlendAndWithoutKinks) {
  const std::vector<Pose> poses{at(0.4, 0, 0, 0, 0, 0.3), at(0.4, 0.4, 0), at(0, 0.4, 0.1)};
  const auto path = PosePath::through(at(0, 0, 0), poses, 0.05);
  ASSERT_TRUE(path) << path.error();
  expect_near(path.value().at(0.0), at(0, 0, 0));
  expect_near(path.value().at(path.value().length()), poses.back());
  const double step = 1e-4;
  double nearest = 1.0;
  double kink = 0.0;
  for (double way = 2 * step; way < path.value().length(); way += step) {
    const Pose a = path.value().at(way - 2 * step);
    const Pose b = path.value().at(way - step);
    const Pose c = path.value().at(way);
    nearest = std::min(nearest, distance(b, poses[0]).way);
    double squares = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      squares += std::pow(c.position[i] - 2 * b.position[i] + a.position[i], 2);
    }
    kink = std::max(kink, std::sqrt(squares) / step);
    ASSERT_NEAR(distance(b, c).way, step, 0.05 * step) << "even, at " << way;
  }
  EXPECT_LT(nearest, 0.05);
  EXPECT_GT(nearest, 0.005);
  EXPECT_LT(kink, 0.02) << "of the direction, in a step";
}

/// Of the second derivative by the way, of the place and of 0.1 m for each rad, by differences.
double measured_bend(const PosePath& path, double way) {
  constexpr double kStep = 2e-3;
  const Pose a = path.at(way - kStep);
  const Pose b = path.at(way);
  const Pose c = path.at(way + kStep);
  double squares = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    squares += std::pow(c.position[i] - 2 * b.position[i] + a.position[i], 2);
  }
  const double turns = 0.1 * std::abs(distance(b, c).angle - distance(a, b).angle);
  return std::max(std::sqrt(squares), turns) / (kStep * kStep);
}

TEST(PosePath, ItsBendBoundsItsSecondDerivative) {
  const auto arc = PosePath::arc(at(0.2, 0, 0), {0, 0.2, 0}, at(-0.2, 0, 0, 0, 0, 1.0)).value();
  EXPECT_NEAR(arc.bend(0.1, 0.1), 1.0 / 0.2, 1e-9);
  EXPECT_EQ(PosePath::line(at(0, 0, 0), at(0.3, 0, 0, 0, 0, 1)).value().bend(0.0, 0.3), 0.0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> far(-0.3, 0.3);
  std::uniform_real_distribution<double> turn(-0.8, 0.8);
  int bends = 0;
  for (int k = 0; k < 60; ++k) {
    std::vector<Pose> poses;
    for (int i = 0; i < 4; ++i) {
      poses.push_back(at(far(random), far(random), far(random), turn(random), 0, turn(random)));
    }
    const auto path = PosePath::through(at(0, 0, 0), poses, 0.05);
    if (!path) continue;
    for (double way = 0.003; way < path.value().length() - 0.003; way += 0.003) {
      const double most = path.value().bend(way - 0.002, way + 0.002);
      ASSERT_LE(measured_bend(path.value(), way), 1.1 * most + 0.05) << k << " at " << way;
      bends += most > 1.0 ? 1 : 0;
    }
  }
  EXPECT_GT(bends, 1000);
}

TEST(PosePath, TurningBackIsRefusedWithThePose) {
  const auto refusal = [](const std::vector<Pose>& poses) {
    const auto path = PosePath::through(at(0, 0, 0), poses, 0.05);
    return path ? "accepted" : path.error();
  };
  const auto turns_back = HasSubstr("at pose 2 the path turns back by more than 170 degrees");
  EXPECT_THAT(refusal({at(0, 0.2, 0), at(0.3, 0.2, 0), at(0.1, 0.2, 0)}), turns_back);
  EXPECT_THAT(refusal({at(0, 0.2, 0), at(0.3, 0.2, 0), at(0.1, 0.21, 0)}), turns_back);
  EXPECT_THAT(refusal({at(0, 0, 0, 0.5), at(0, 0, 0, 1.0), at(0, 0, 0, 0.2)}), turns_back)
      << "by its turn alone";
  EXPECT_EQ(refusal({at(0, 0.2, 0), at(0.3, 0.2, 0), at(0.1, 0.25, 0)}), "accepted");
  EXPECT_EQ(refusal({at(0, 0.2, 0), at(0.3, 0.2, 0), at(0.1, 0.2, 0, 0, 0, 2)}), "accepted")
      << "its turn leads round";
}

TEST(PosePath, ADoubledPoseIsRefusedWithItsNumber) {
  const std::vector<Pose> poses{at(0.2, 0, 0), at(0.2, 0.2, 0), at(0.2, 0.2, 0), at(0, 0.2, 0)};
  EXPECT_THAT(PosePath::through(at(0, 0, 0), poses, 0.05).error(),
              HasSubstr("pose 3 is where pose 2 is, the one before: leave it out"));
}

TEST(PosePath, WhatIsNoPathIsToldWhy) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(PosePath::line(at(0, 0, 0), at(0, 0, 0)).error(),
              HasSubstr("pose 1 is where the path begins: leave it out"));
  EXPECT_THAT(PosePath::line(at(0, 0, 0), at(none, 0, 0)).error(), HasSubstr("not finite"));
  EXPECT_THAT(PosePath::arc(at(0, 0, 0), {1, 0, 0}, at(2, 0, 0)).error(), HasSubstr("on one line"));
  EXPECT_THAT(PosePath::arc(at(0, 0, 0), {1, 0, 0}, at(0, 0, 0)).error(), HasSubstr("on one line"));
  EXPECT_THAT(PosePath::arc(at(0, 0, 0), {none, 0, 0}, at(0, 1, 0)).error(),
              HasSubstr("not finite"));
  EXPECT_THAT(PosePath::through(at(0, 0, 0), {}, 0.1).error(), HasSubstr("no pose"));
  const std::vector<Pose> two{at(1, 0, 0), at(1, 1, 0)};
  EXPECT_THAT(PosePath::through(at(0, 0, 0), two, 0.0).error(), HasSubstr("expected one above 0"));
  EXPECT_THAT(PosePath::through(at(0, 0, 0), two, none).error(), HasSubstr("expected one above 0"));
}

}  // namespace
}  // namespace armature::control
