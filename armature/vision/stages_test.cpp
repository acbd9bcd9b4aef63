// SPDX-License-Identifier: Apache-2.0
#include "armature/vision/stages.hpp"

#include <gtest/gtest.h>

#include "armature/vision/internal/test_scene.hpp"

namespace armature::vision {
namespace {

using test::kGrey;
using test::kRed;
using test::Scene;

constexpr Rgb kBlack{};
constexpr Rgb kWhite{255, 255, 255};

/// A ball, and a box of its colour.
class StagesTest : public ::testing::Test {
 protected:
  StagesTest() {
    scene_.disc(20, 20, 8, kRed);
    scene_.box(40, 10, 56, 26, kRed);
    ball_ = finder_.find(scene_.view());
  }

  Scene scene_{{64, 48}};
  BallFinder finder_ = BallFinder::make({.shape = {64, 48}}).value();
  std::optional<BallFinder::Ball> ball_;
};

TEST_F(StagesTest, TheColourDistanceIsWhiteWhereTheColourIs) {
  const Image image = colour_distance_image(finder_.threshold(), scene_.view());
  EXPECT_EQ(image.at(20, 20), kWhite);
  EXPECT_EQ(image.at(45, 15), kWhite);
  EXPECT_EQ(image.at(5, 40), kBlack);
}

TEST_F(StagesTest, TheMaskIsBlackAndWhite) {
  const Image image = mask_image(finder_);
  EXPECT_EQ(image.at(20, 20), kWhite);
  EXPECT_EQ(image.at(5, 40), kBlack);
}

TEST_F(StagesTest, EachBlobHasItsColour) {
  const Image image = blob_image(finder_);
  EXPECT_NE(image.at(20, 20), kBlack);
  EXPECT_EQ(image.at(20, 20), image.at(24, 22));
  EXPECT_NE(image.at(20, 20), image.at(45, 15));
  EXPECT_EQ(image.at(5, 40), kBlack);
}

TEST_F(StagesTest, TheBallIsFramedAndItsCentreMarked) {
  ASSERT_TRUE(ball_);
  const Image image = ball_image(scene_.view(), finder_, ball_);
  const Rgb mark{0, 255, 0};
  EXPECT_EQ(image.at(20, 20), mark);
  EXPECT_EQ(image.at(20, 11), mark) << "the frame above it";
  EXPECT_EQ(image.at(5, 40), kGrey);
  EXPECT_EQ(image.at(45, 15), kRed) << "the box is not marked";
}

TEST_F(StagesTest, WithoutABallTheImageStaysAsItIs) {
  EXPECT_EQ(ball_image(scene_.view(), finder_, std::nullopt).bytes(), scene_.image().bytes());
}

TEST(Stages, AMarkAtTheBorderStaysInside) {
  Scene scene({64, 48});
  scene.disc(1, 47, 8, kRed);
  BallFinder finder = BallFinder::make({.shape = {64, 48}}).value();
  const auto ball = finder.find(scene.view());
  ASSERT_TRUE(ball);
  const Image image = ball_image(scene.view(), finder, ball);
  EXPECT_EQ(image.at(static_cast<int>(ball->x), static_cast<int>(ball->y)), (Rgb{0, 255, 0}));
}

}  // namespace
}  // namespace armature::vision
