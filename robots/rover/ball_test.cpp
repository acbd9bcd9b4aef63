// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/ball.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"
#include "robots/rover/numbers.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;

struct BallTest : public ::testing::Test {
  void begin(const char* way) {
    ball.set("Way", std::string_view(way));
    ASSERT_TRUE(ball.start()) << ball.reason();
  }
  BallPoint after(double seconds) {
    ball.run_cycles(static_cast<int>(std::lround(100.0 * seconds)));
    return ball.output<BallPoint>("Point");
  }

  testing::Harness ball{std::make_unique<Ball>("Ball"), 10ms};
};

TEST_F(BallTest, RestsOneMetreBeforeTheCamera) {
  begin("rest");
  const BallPoint point = after(3.0);
  EXPECT_DOUBLE_EQ(point.x, kBeginX + kCameraAhead + 1.0);
  EXPECT_EQ(point.y, 0.0);
  EXPECT_EQ(point.z, kBallRadius);
}

TEST_F(BallTest, RollsALineWithAStop) {
  begin("line");
  EXPECT_NEAR(after(2.0).x, kBallRestX + 0.6, 0.01);
  EXPECT_NEAR(after(2.0).x, kBallRestX + 1.0, 0.01);
  EXPECT_NEAR(after(1.0).x, kBallRestX + 1.0, 0.01);
  EXPECT_NEAR(after(5.0).x, kBallRestX + 2.0, 0.01);
}

TEST_F(BallTest, RollsACircleOfOneAndAHalfMetres) {
  begin("circle");
  after(10.0);
  double angle = std::atan2(after(0.01).y, ball.output<BallPoint>("Point").x);
  for (int k = 0; k < 40; ++k) {
    const BallPoint point = after(1.0);
    EXPECT_NEAR(std::hypot(point.x, point.y), 1.5, 1e-9);
    const double now = std::atan2(point.y, point.x);
    EXPECT_NEAR(std::remainder(now - angle, 2.0 * std::numbers::pi), 0.2, 0.001);
    angle = now;
  }
}

TEST_F(BallTest, RollsAnEightWithinTheArenaAtItsSpeed) {
  begin("eight");
  after(10.0);
  BallPoint last = after(0.01);
  for (int k = 0; k < 5000; ++k) {
    const BallPoint point = after(0.01);
    EXPECT_NEAR(std::hypot(point.x - last.x, point.y - last.y), 0.003, 1e-4);
    EXPECT_LT(std::abs(point.x), 1.6);
    EXPECT_LT(std::abs(point.y), 0.9);
    last = point;
  }
}

TEST_F(BallTest, HidesBehindTheScreen) {
  begin("hide");
  EXPECT_EQ(after(12.0).x, 2.45) << "behind the screen, which is at 2.1 m";
  EXPECT_LT(ball.output<BallPoint>("Point").y, 0.0);
  EXPECT_EQ(after(8.0).x, 2.45);
  EXPECT_EQ(ball.output<BallPoint>("Point").y, 0.7);
}

TEST_F(BallTest, IsCarriedBehindTheRoverAboveItsView) {
  begin("rest");
  ball.write("Place", Place{0.5, 0.2, std::numbers::pi / 2.0});
  ASSERT_TRUE(ball.call<void>("go", BallWay::kCarry));
  EXPECT_GT(after(0.6).z, 0.8);
  const BallPoint point = after(3.0);
  EXPECT_NEAR(point.x, 0.5, 1e-9);
  EXPECT_NEAR(point.y, -0.8, 1e-9);
  EXPECT_EQ(point.z, kBallRadius);
}

TEST_F(BallTest, IsWhereThePortsAreWithinTheArena) {
  begin("ports");
  ball.write("X", 1.0);
  ball.write("Y", 5.0);
  const BallPoint point = after(0.01);
  EXPECT_EQ(point.x, 1.0);
  EXPECT_EQ(point.y, 1.9);
  ball.write("X", std::nan(""));
  EXPECT_EQ(after(0.01).x, 1.0);
}

}  // namespace
}  // namespace armature::rover
