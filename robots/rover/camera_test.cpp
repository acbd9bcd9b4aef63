// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/camera.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"
#include "robots/rover/numbers.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;

using Image = std::vector<std::uint8_t>;

struct CameraTest : public ::testing::Test {
  CameraTest() { camera.set("Noise", 0.0); }
  void begin() { ASSERT_TRUE(camera.start()) << camera.reason(); }
  const Image& next(const Place& rover, const BallPoint& ball) {
    camera.write("Place", rover);
    camera.write("Ball", ball);
    camera.run_cycles();
    return camera.output<Image>("Image");
  }

  testing::Harness camera{std::make_unique<Camera>("Camera"), 50ms};
};

/// Of the ball's colour [px] from the left and from the top.
std::pair<double, double> spot(const Image& image) {
  double x = 0.0;
  double y = 0.0;
  int count = 0;
  for (std::size_t at = 0; at < image.size(); at += 3) {
    if (image[at] < 100 || image[at + 1] > 60 || image[at + 2] > 60) continue;
    x += static_cast<double>(at / 3 % 320) + 0.5;
    y += static_cast<double>(at / 3 / 320) + 0.5;
    ++count;
  }
  return {x / count, y / count};
}

TEST_F(CameraTest, HasABallOneMetreAheadInTheMiddle) {
  begin();
  const auto [x, y] = spot(next({kBeginX, 0.0, 0.0}, {kBallRestX, 0.0, kBallRadius}));
  EXPECT_NEAR(x, 160.0, 0.3);
  EXPECT_NEAR(y, 120.0, 0.5);
}

TEST_F(CameraTest, SeesWithTheRoversHeading) {
  begin();
  const double heading = 1.0;
  const double ahead = kCameraAhead + 1.0;
  const BallPoint ball{0.3 + ahead * std::cos(heading), -0.2 + ahead * std::sin(heading),
                       kBallRadius};
  const auto [x, y] = spot(next({0.3, -0.2, heading}, ball));
  EXPECT_NEAR(x, 160.0, 0.3);
  EXPECT_NEAR(y, 120.0, 0.5);
  const auto [left, unused] = spot(next({0.3, -0.2, heading - 0.1}, ball));
  EXPECT_LT(left, 140.0) << "the rover looks to the right of the ball";
  static_cast<void>(unused);
}

TEST_F(CameraTest, TheScreenHidesTheBallForMoreThanASecond) {
  begin();
  int hidden = 0;
  for (double y = -0.7; y <= 0.7; y += 0.3 * 0.05) {
    const auto [x, unused] = spot(next({1.45, 0.0, 0.0}, {2.45, y, kBallRadius}));
    static_cast<void>(unused);
    hidden += std::isnan(x) ? 1 : 0;
  }
  EXPECT_GE(hidden, 24) << "images of 20 a second, at 0.3 m/s";
  EXPECT_LE(hidden, 36);
}

TEST_F(CameraTest, APlaceThatIsNoNumberLeavesItWhereItWas) {
  begin();
  const Image before = next({0.5, 0.0, 0.0}, {1.5, 0.0, kBallRadius});
  const double nan = std::nan("");
  EXPECT_EQ(before, next({nan, 0.0, nan}, {1.5, nan, kBallRadius}));
  EXPECT_EQ(before, next({1e300, 0.0, 0.0}, {1.5, 0.0, kBallRadius}));
}

TEST_F(CameraTest, AnImageForEachCycleOfTheSizeThatIsAskedFor) {
  camera.set("ImageWidth", 160);
  camera.set("ImageHeight", 120);
  begin();
  camera.run_cycles(5);
  EXPECT_EQ(camera.writes("Image"), 5U);
  EXPECT_EQ(camera.output<Image>("Image").size(), 160U * 120U * 3U);
  EXPECT_EQ(camera.get<int>("images"), 5);
}

TEST_F(CameraTest, NoiseDiffersFromImageToImage) {
  camera.set("Noise", 2.0);
  begin();
  const Image first = next({}, {1.0, 0.0, kBallRadius});
  EXPECT_NE(first, next({}, {1.0, 0.0, kBallRadius}));
}

TEST_F(CameraTest, FreezesAndGoesAway) {
  camera.set("Noise", 2.0);
  begin();
  const Image last = next({}, {1.0, 0.0, kBallRadius});
  camera.set("Fault", std::string_view("frozen"));
  EXPECT_EQ(last, next({}, {0.5, 0.0, kBallRadius}));
  EXPECT_EQ(camera.writes("Image"), 2U);
  camera.set("Fault", std::string_view("gone"));
  next({}, {0.5, 0.0, kBallRadius});
  EXPECT_EQ(camera.writes("Image"), 2U);
  camera.set("Fault", std::string_view("none"));
  EXPECT_NE(last, next({}, {0.5, 0.0, kBallRadius}));
}

}  // namespace
}  // namespace armature::rover
