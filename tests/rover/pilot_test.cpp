// SPDX-License-Identifier: Apache-2.0
// The rover follows a ball by its control program, which is wired of controls: all in one process,
// in simulated time.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "robots/rover/numbers.hpp"
#include "tests/rover/watching.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<Sight> last(const std::vector<Sight>& sights, std::size_t count) {
  return {sights.end() - static_cast<std::ptrdiff_t>(std::min(count, sights.size())), sights.end()};
}

// --- following -------------------------------------------------------------------------------

TEST(Pilot, KeepsABallAtRestInTheMiddleOfThePicture) {
  Watched rover({"Ball.BeginX=0.3", "Ball.BeginY=0.4"});
  rover.start();
  const Following at_rest = following(last(rover.watch(12s), 40));
  EXPECT_LE(at_rest.distance_error_m, 0.02);
  EXPECT_LE(at_rest.bearing_rad, 0.5 * kDegree);
}

TEST(Pilot, TurnsToABallBesideItsAxis) {
  Watched rover;
  rover.start();
  rover.watch(3s);
  rover.turn(28 * kDegree);
  const StepAnswer step = step_answer(rover.watch(3s));
  EXPECT_LE(step.after_1_s_rad, 3 * kDegree);
  EXPECT_LE(step.overshoot, 0.1);
}

TEST(Pilot, FollowsACircle) {
  Watched rover;
  rover.start();
  rover.go(BallWay::kCircle);
  const std::vector<Sight> sights = rover.watch(45s);
  const Following on_circle = following(last(sights, 300));
  EXPECT_LE(on_circle.distance_error_m, 0.35);
  EXPECT_LE(on_circle.bearing_rad, 8 * kDegree);
  EXPECT_GE(following(sights).nearest_m, 0.5);
  const Recognition seen = recognition(sights);
  EXPECT_GE(seen.whole, 400U);
  EXPECT_GE(static_cast<double>(seen.found), 0.995 * static_cast<double>(seen.whole));
  EXPECT_EQ(seen.claimed, 0U);
  EXPECT_LE(seen.rms_px, 0.5);
  EXPECT_LE(seen.p99_px, 1.0);
}

TEST(Pilot, WithIntegratorsFollowsACircleWithoutALag) {
  Watched rover({}, "rover_pi.yaml");
  rover.start();
  rover.go(BallWay::kCircle);
  const Following on_circle = following(last(rover.watch(45s), 300));
  EXPECT_LE(on_circle.distance_error_m, 0.05);
  EXPECT_LE(on_circle.bearing_rad, 1.5 * kDegree);
}

TEST(Pilot, StandsBackFromABallThatIsTooNear) {
  Watched rover({"Ball.BeginX=-0.87"});  // 0.55 m
  rover.start();
  const std::vector<Sight> sights = rover.watch(6s);
  EXPECT_GE(following(sights).nearest_m, 0.5);
  EXPECT_LE(following(last(sights, 20)).distance_error_m, 0.02);
}

TEST(Pilot, DrivesAtMostAsFastAsTheSliderSays) {
  Watched rover({"Ball.BeginX=1.9"});
  rover.start();
  ASSERT_TRUE(rover.robot.application().call("TopSpeed", "move", {types::Value::of(0.2)}));
  rover.watch(2s);
  EXPECT_NEAR(rover.fastest(), 0.2, 0.02);
  ASSERT_TRUE(rover.robot.application().call("TopSpeed", "move", {types::Value::of(0.0)}));
  rover.watch(1s);
  EXPECT_LT(rover.fastest(), 0.02);
}

TEST(Pilot, WithFourWheelsIsTheSame) {
  Watched rover({"wheels=4"});
  rover.start();
  rover.go(BallWay::kCircle);
  const Following on_circle = following(last(rover.watch(45s), 300));
  EXPECT_LE(on_circle.distance_error_m, 0.35);
  EXPECT_LE(on_circle.bearing_rad, 8 * kDegree);
}

TEST(Pilot, TwiceTheSameToTheBit) {
  std::vector<double> before;
  for (int run = 0; run < 2; ++run) {
    Watched rover;
    rover.start();
    rover.go(BallWay::kEight);
    std::vector<double> now;
    for (const Sight& sight : rover.watch(5s)) {
      now.insert(now.end(), {sight.view.x, sight.view.y, sight.view.heading});
      if (sight.seen) now.insert(now.end(), {sight.seen->x, sight.seen->y});
    }
    if (run == 1) {
      EXPECT_EQ(now, before);
    }
    before = now;
  }
  EXPECT_GE(before.size(), 400U);
}

// --- the ball is not there -------------------------------------------------------------------

TEST(Pilot, FindsABallThatWasBehindTheScreen) {
  Watched rover;
  rover.start();
  rover.go(BallWay::kHide);
  bool hidden = false;
  double back = 0.0;
  std::vector<Sight> sights = rover.watch(18s);
  for (const Sight& sight : sights) {
    const bool gone = in_sight(sight.view) == InSight::kNothing;
    if (hidden && !gone && back == 0.0) back = sight.time_s;
    hidden = hidden || gone;
  }
  ASSERT_TRUE(hidden) << "the ball went behind the screen";
  ASSERT_GT(back, 0.0);
  const auto found = found_after(sights, back);
  ASSERT_TRUE(found);
  EXPECT_LE(*found, 1.0);
}

TEST(Pilot, TurnsUntilItFindsABallThatWasCarriedBehindIt) {
  Watched rover;
  rover.start();
  rover.watch(1s);
  rover.go(BallWay::kCarry);
  const std::vector<Sight> sights = rover.watch(20s);
  double back = 0.0;
  bool carried = false;
  for (const Sight& sight : sights) {
    if (sight.view.ball_z > 0.06) carried = true;
    if (carried && sight.view.ball_z <= 0.06 && back == 0.0) back = sight.time_s;
  }
  ASSERT_GT(back, 0.0);
  const auto found = found_after(sights, back);
  ASSERT_TRUE(found);
  EXPECT_LE(*found, 14.0);
}

TEST(Pilot, SearchesABallThatIsNowhereAndGivesUpWithARedLight) {
  Watched rover({"Ball.BeginX=2.5"});  // behind the screen
  rover.start();
  rover.robot.run_for(3s);
  EXPECT_NEAR(rover.robot.speed(1) - rover.robot.speed(0), 0.5 * kTrack, 0.02);
  EXPECT_FALSE(rover.robot.value<bool>("GivenUp", "Above"));
  rover.robot.run_for(14s);
  EXPECT_TRUE(rover.robot.value<bool>("GivenUp", "Above"));
  EXPECT_TRUE(rover.robot.rests());
}

// --- it is told ------------------------------------------------------------------------------

TEST(Pilot, UnarmedNothingMoves) {
  Watched rover({"Ball.BeginX=1"});
  rover.robot.start();
  rover.robot.run_for(3s);
  EXPECT_TRUE(rover.robot.value<bool>("Vision", "Seen"));
  EXPECT_LT(rover.fastest(), 1e-3);
  EXPECT_FALSE(rover.robot.value<bool>("Arming", "armed"));
}

TEST(Pilot, HaltsAndGoesAgain) {
  Watched rover({"Ball.BeginX=1.9", "K2.Value=0.02"});
  rover.start();
  rover.watch(2s);
  ASSERT_GT(rover.fastest(), 0.5);
  ASSERT_TRUE(rover.robot.application().call("Halt", "press", {}));
  EXPECT_LE(rover.time_to_rest(), 0.8);
  rover.robot.run_for(20s);
  EXPECT_LT(rover.fastest(), 0.01) << "it does not search, either";
  ASSERT_TRUE(rover.robot.application().call("Go", "press", {}));
  rover.robot.run_for(1500ms);
  EXPECT_GT(rover.fastest(), 0.1);
}

TEST(Pilot, ShowsWhereTheBallIs) {
  Watched rover({"Ball.BeginX=0.3", "Ball.BeginY=0.4"});
  rover.robot.start();
  rover.robot.run_for(1s);
  EXPECT_FALSE(rover.robot.value<bool>("IsRight", "Above"));
  EXPECT_TRUE(rover.robot.value<bool>("NotRight", "Out"));
  EXPECT_TRUE(rover.robot.value<bool>("IsFar", "Above"));
  EXPECT_FALSE(rover.robot.value<bool>("NotFar", "Out"));
}

// --- faults, from 0.6 m/s --------------------------------------------------------------------

struct PilotFault : public ::testing::Test {
  PilotFault() : rover({"Ball.BeginX=1.9", "K2.Value=0.02"}) {
    rover.start();
    rover.watch(2s);
    EXPECT_NEAR(rover.fastest(), 0.6, 0.03);
  }

  Watched rover;
};

TEST_F(PilotFault, AFrozenImageEndsInASmoothStopInOneSecond) {
  rover.robot.set("Camera", "Fault", types::Value::of(CameraFault::kFrozen));
  EXPECT_LE(rover.time_to_rest(), 1.0);
  EXPECT_GE(rover.robot.value<int>("Vision", "EqualImages"), 3);
  rover.robot.run_for(5s);
  EXPECT_LT(rover.fastest(), 0.01) << "it does not search with a camera that is frozen";
}

TEST_F(PilotFault, ACameraThatIsGoneEndsInASmoothStopInOneSecond) {
  rover.robot.set("Camera", "Fault", types::Value::of(CameraFault::kGone));
  EXPECT_LE(rover.time_to_rest(), 1.0);
  rover.robot.run_for(5s);
  EXPECT_LT(rover.fastest(), 0.01);
}

TEST_F(PilotFault, ACameraThatIsWellAgainIsFollowedFromRest) {
  rover.robot.set("Camera", "Fault", types::Value::of(CameraFault::kGone));
  rover.robot.run_for(5s);
  rover.robot.set("Camera", "Fault", types::Value::of(CameraFault::kNone));
  rover.robot.run_for(4s);
  EXPECT_GT(rover.fastest(), 0.1);
}

TEST_F(PilotFault, AVisionThatStopsEndsInASmoothStop) {
  ASSERT_TRUE(rover.robot.application().stop_component("Vision"));
  EXPECT_LE(rover.time_to_rest(), 1.0);
}

TEST_F(PilotFault, AWheelThatFailsStopsBothAndArmsNothing) {
  rover.robot.set("Rover", "SilentEncoder", types::Value::of(1));
  EXPECT_LE(rover.time_to_rest(), 1.0);
  EXPECT_THAT(rover.robot.reason("Chassis.Drive"),
              HasSubstr("wheel 1 (Chassis.Joint1) has failed"));
  rover.robot.set("Rover", "SilentEncoder", types::Value::of(0));
  rover.robot.run_for(5s);
  EXPECT_LT(rover.fastest(), 0.01);
  EXPECT_FALSE(rover.robot.value<bool>("Arming", "armed"));
}

}  // namespace
}  // namespace armature::rover
