// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/ball_finder.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/realtime_guard.hpp"
#include "armature/vision/internal/test_scene.hpp"

namespace armature::vision {
namespace {

using test::kRed;
using test::Scene;
using ::testing::HasSubstr;

constexpr ImageShape kShape{320, 240};
constexpr Rgb kOrange{230, 130, 20};
constexpr Rgb kBlue{30, 60, 200};

BallFinder finder_of(const BallFinder::Config& config = {}) {
  return BallFinder::make(config).value();
}

TEST(BallFinder, SeesNothingOnAnEmptyFloor) {
  BallFinder finder = finder_of();
  EXPECT_FALSE(finder.find(Scene(kShape).view()));
}

TEST(BallFinder, CentresOfDiscsAreExactToThreeTenthsOfAPixel) {
  BallFinder finder = finder_of();
  std::mt19937 source(1);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  double squares = 0.0;
  double worst = 0.0;
  constexpr int kDiscs = 60;
  for (int i = 0; i < kDiscs; ++i) {
    const double radius = 3.2 + 28.8 * any(source) * any(source);
    const double x = radius + 1 + (kShape.width - 2 * radius - 2) * any(source);
    const double y = radius + 1 + (kShape.height - 2 * radius - 2) * any(source);
    Scene scene(kShape);
    scene.disc(x, y, radius, kRed);
    scene.add_noise(4.0, static_cast<unsigned>(i));
    const auto ball = finder.find(scene.view());
    ASSERT_TRUE(ball) << "radius " << radius << " at " << x << ", " << y;
    EXPECT_FALSE(ball->cut);
    const double error = std::hypot(ball->x - x, ball->y - y);
    squares += error * error;
    worst = std::max(worst, error);
  }
  EXPECT_LE(std::sqrt(squares / kDiscs), 0.3);
  EXPECT_LE(worst, 1.0);
}

TEST(BallFinder, AnOrangePostAndABlueBoxAreNoBall) {
  BallFinder finder = finder_of();
  Scene scene(kShape);
  scene.box(40, 20, 60, 200, kOrange);
  scene.box(200, 100, 280, 180, kBlue);
  scene.add_noise(6.0, 3);
  EXPECT_FALSE(finder.find(scene.view()));
}

TEST(BallFinder, ABoxOfTheBallsColourIsNotRound) {
  BallFinder finder = finder_of();
  Scene scene(kShape);
  scene.box(100, 100, 140, 140, kRed);
  EXPECT_FALSE(finder.find(scene.view()));
  EXPECT_EQ(finder.blobs().size(), 1u) << "it is seen, and refused";
  scene.disc(250, 60, 10, kRed);
  const auto ball = finder.find(scene.view());
  ASSERT_TRUE(ball) << "though the box is larger";
  EXPECT_NEAR(ball->x, 250, 0.3);
}

TEST(BallFinder, AFrameOrACrossOfTheBallsColourIsNotRound) {
  BallFinder finder = finder_of();
  Scene scene(kShape);
  scene.box(100, 100, 160, 106, kRed);
  scene.box(100, 100, 106, 160, kRed);
  EXPECT_FALSE(finder.find(scene.view()));
}

TEST(BallFinder, TheLargestOfTwoBallsIsTaken) {
  BallFinder finder = finder_of();
  Scene scene(kShape);
  scene.disc(50, 50, 12, kRed);
  scene.disc(200, 150, 14, kRed);
  const auto ball = finder.find(scene.view());
  ASSERT_TRUE(ball);
  EXPECT_NEAR(ball->x, 200, 0.3);
  EXPECT_NEAR(ball->area, 3.14159 * 14 * 14, 20);
}

TEST(BallFinder, WhatIsSmallerThanMinAreaIsNoBall) {
  Scene scene(kShape);
  scene.disc(100, 100, 3.0, kRed);
  BallFinder all = finder_of({.min_area = 20});
  BallFinder large = finder_of({.min_area = 40});
  EXPECT_TRUE(all.find(scene.view()));
  EXPECT_FALSE(large.find(scene.view()));
}

/// At the left border and in a corner: what is seen of it says where to turn.
TEST(BallFinder, ABallThatTheBorderCutsHasTheMiddleOfWhatIsSeen) {
  BallFinder finder = finder_of();
  for (const double x : {-8.0, 0.0, 10.0, 19.0}) {
    Scene scene(kShape);
    scene.disc(x, 120, 20, kRed);
    const auto ball = finder.find(scene.view());
    ASSERT_TRUE(ball) << x;
    EXPECT_TRUE(ball->cut) << x;
    EXPECT_NEAR(ball->y, 120, 0.3);
    EXPECT_GT(ball->x, std::max(0.0, x));
    EXPECT_LT(ball->x - x, 20) << "less than its radius off";
  }
  Scene corner(kShape);
  corner.disc(315, 236, 20, kRed);
  const auto ball = finder.find(corner.view());
  ASSERT_TRUE(ball);
  EXPECT_TRUE(ball->cut);
  EXPECT_GT(ball->x, 295);
  EXPECT_GT(ball->y, 216);
}

TEST(BallFinder, ABallBehindAScreensEdgeHasTheMiddleOfWhatIsSeen) {
  BallFinder finder = finder_of();
  Scene scene(kShape);
  scene.disc(160, 120, 20, kRed);
  scene.box(160, 0, 260, 240, {60, 60, 60});
  const auto ball = finder.find(scene.view());
  ASSERT_TRUE(ball);
  EXPECT_FALSE(ball->cut);
  EXPECT_NEAR(ball->x, 160 - 4.0 / 3.0 / 3.14159 * 20, 0.6) << "the centre of half a disc";
  EXPECT_NEAR(ball->y, 120, 0.3);
}

TEST(BallFinder, LooksForAnotherColourWhenAsked) {
  BallFinder finder = finder_of();
  Scene scene(kShape);
  scene.disc(80, 80, 10, {30, 60, 210});
  EXPECT_FALSE(finder.find(scene.view()));
  finder.look_for(ColourThreshold::make({.wanted = {0, 0, 255}, .hue_tolerance_rad = 0.3}).value());
  EXPECT_TRUE(finder.find(scene.view()));
}

TEST(BallFinder, FindsWithoutMemory) {
  BallFinder finder = finder_of();
  Scene scene(kShape);
  scene.disc(80, 80, 10, kRed);
  scene.add_noise(60.0, 5);
  const ::armature::testing::RealtimeGuard guard;
  static_cast<void>(finder.find(scene.view()));
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

TEST(BallFinder, MistakesNameTheirFields) {
  const auto wrong =
      BallFinder::make({.shape = {0, -3}, .min_area = 0, .min_fill = 0.9, .max_fill = 0.8});
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error(), HasSubstr("shape.width is 0, expected above 0"));
  EXPECT_THAT(wrong.error(), HasSubstr("shape.height is -3, expected above 0"));
  EXPECT_THAT(wrong.error(), HasSubstr("min_area is 0, expected above 0"));
  EXPECT_THAT(wrong.error(), HasSubstr("min_fill is 0.9, expected less than max_fill"));
  EXPECT_FALSE(BallFinder::make({.colour = {.wanted = {1, 1, 1}}}));
}

}  // namespace
}  // namespace armature::vision
