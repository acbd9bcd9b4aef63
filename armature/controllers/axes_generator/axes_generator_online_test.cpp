// SPDX-License-Identifier: Apache-2.0
// Two axes with 1 rad/s, 2 rad/s^2, 20 rad/s^3, -0.5 to 4.5 rad, in simulated cycles of 10 ms.
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/controllers/internal/test_online_generator.hpp"

namespace armature::controllers {
namespace {

using component::CommandStage;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(OnlineGenerator, TheReferenceIsTheMeasuredPositionBeforeTheFirstMotion) {
  start_at({0.25, 0.5});
  measured = {0.3, 0.4};
  cycle(3);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(OnlineGenerator, AllAxesArriveTogetherAtTheirTargets) {
  start_at({0.0, 0.5});
  auto motion = generator.send("moveTo", Vector{2.0, 1.0}, 0.0);
  // X / V + V / A + A / J = 2.6 s.
  cycle(259);
  EXPECT_EQ(motion.stage(), CommandStage::kAccepted);
  EXPECT_NE(velocity()[1], 0.0);
  cycle(1);
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_THAT(desired(), ElementsAre(2.0, 1.0));
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(OnlineGenerator, AMotionIsRedirectedOnTheWayWithoutAStop) {
  start_at({0.0, 0.5});
  auto motion = generator.send("moveTo", Vector{3.0, 1.0}, 0.0);
  cycle(100);
  EXPECT_TRUE(generator.call<bool>("changeTarget", Vector{4.0, 0.0}).value());
  EXPECT_FALSE(generator.call<bool>("changeTarget", Vector{9.0, 0.0}).value());
  cycle(10);
  EXPECT_NEAR(velocity()[0], 1.0, 1e-6);
  cycle(500);
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_THAT(desired(), ElementsAre(4.0, 0.0));
  EXPECT_FALSE(generator.call<bool>("changeTarget", Vector{1.0, 0.0}).value()) << "none is";
}

TEST_F(OnlineGenerator, TellsHowFarAMotionIsAndHowLongItStillTakes) {
  start_at({0.0, 0.5});
  auto motion = generator.send("moveTo", Vector{2.0, 1.0}, 0.0);
  cycle(65);  // of 2.6 s
  EXPECT_NEAR(generator.get<double>("progress"), 0.25, 1e-6);
  EXPECT_NEAR(generator.get<double>("remaining_time"), 1.95, 1e-6);
  EXPECT_NEAR(motion.progress(), 0.25, 1e-6);
  cycle(200);
  EXPECT_EQ(generator.get<double>("progress"), 1.0);
  EXPECT_EQ(generator.get<double>("remaining_time"), 0.0);
}

TEST_F(OnlineGenerator, StopBrakesOnTheWayAndHoldsThere) {
  start_at({0.0, 0.5});
  auto motion = generator.send("moveTo", Vector{4.0, 4.0}, 0.0);
  cycle(150);
  generator.raise("Stop");
  cycle(61);
  EXPECT_EQ(motion.stage(), CommandStage::kFailed);
  EXPECT_THAT(velocity(), Each(0.0));
  const Vector there = desired();
  EXPECT_LT(there[0], 2.0);
  cycle(100);
  EXPECT_EQ(desired(), there);
}

TEST_F(OnlineGenerator, ACancelledMotionBrakesAndTheNextOneBeginsMeanwhile) {
  start_at({0.0, 0.5});
  auto motion = generator.send("moveTo", Vector{4.0, 4.0}, 0.0);
  cycle(150);
  motion.cancel();
  cycle(10);
  EXPECT_GT(velocity()[0], 0.5);
  EXPECT_EQ(refusal_of({0.0, 0.0}, 0.0), "accepted");
  cycle(700);
  EXPECT_THAT(desired(), ElementsAre(0.0, 0.0));
}

TEST_F(OnlineGenerator, RefusesWhatCannotBeWithTheReasonAndNothingMoves) {
  start_at({0.25, 0.5});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal_of({1.0}, 1.0), "expected one number for each axis: expected 2, found 1");
  EXPECT_EQ(refusal_of({1.0, 5.0}, 1.0),
            "axis 2: a target is outside the limits of its axis: 5, expected -0.5 to 4.5");
  EXPECT_EQ(refusal_of({nan, 1.0}, 1.0), "axis 1: a number is not finite: nan");
  EXPECT_EQ(refusal_of({1.0, 1.0}, nan), "a number is not finite: the time is nan");
  EXPECT_EQ(refusal_of({1.0, 1.0}, -1.0), "the time is negative: -1");
  EXPECT_THAT(refusal_of({2.25, 1.0}, 2.0), HasSubstr("it takes 2.6 s at least, found 2 s"));
  cycle(10);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
}

TEST_F(OnlineGenerator, MovesNothingBeforeAnythingWasMeasured) {
  ASSERT_TRUE(generator.start()) << generator.reason();
  generator.run_cycles(3);
  EXPECT_EQ(generator.writes("nAxesDesiredPosition"), 0u);
  EXPECT_THAT(refusal_of({1.0, 1.0}, 0.0), HasSubstr("not known yet"));
}

TEST_F(OnlineGenerator, MotionsAreRefusedUntilTheRobotIsArmed) {
  bool armed = false;
  generator.serve<bool()>("isArmed", [&armed] { return armed; });
  start_at({0.25, 0.5});
  generator.write("nAxesReferencePosition", Vector{1.0, 1.0});
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "the robot is not armed: arm first");
  EXPECT_FALSE(generator.call("follow"));
  cycle(10);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
  armed = true;
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "accepted");
  cycle(30);
  generator.raise("Disarm");
  generator.write("nAxesSensorPosition", measured);
  generator.run_cycles();
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5)) << "as measured";
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(OnlineGenerator, MovesToReferencesOnlyWhileItIsCommandedToFollow) {
  start_at({0.0, 0.0});
  generator.write("nAxesReferencePosition", Vector{1.0, 1.0});
  cycle(20);
  EXPECT_THAT(desired(), ElementsAre(0.0, 0.0));
  generator.write("nAxesReferencePosition", Vector{1.0, 1.0});
  auto follow = generator.send("follow");
  for (int i = 0; i < 400; ++i) {
    generator.write("nAxesReferencePosition", Vector{1.0 + 0.005 * i, 1.0 + 0.1 * (i % 2)});
    cycle();
  }
  EXPECT_EQ(follow.stage(), CommandStage::kAccepted);
  EXPECT_NEAR(desired()[0], 2.995, 0.3);
  follow.cancel();
  cycle(100);
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(OnlineGenerator, ReferencesThatAreNotAdmissibleAreCountedAndNotFollowed) {
  start_at({0.0, 0.0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  generator.write("nAxesReferencePosition", Vector{1.0, 1.0});
  auto follow = generator.send("follow");
  cycle();
  for (const Vector& wrong : {Vector{nan, 1.0}, Vector{1.0, 99.0}}) {
    for (int i = 0; i < 100; ++i) {
      generator.write("nAxesReferencePosition", wrong);
      cycle();
    }
  }
  EXPECT_EQ(follow.stage(), CommandStage::kAccepted);
  EXPECT_EQ(generator.get<int>("refused_references"), 200);
  EXPECT_THAT(desired(), ElementsAre(1.0, 1.0));
}

TEST_F(OnlineGenerator, BrakesWhenItsReferencesFallSilent) {
  start_at({0.0, 0.0});
  generator.write("nAxesReferencePosition", Vector{4.0, 4.0});
  auto follow = generator.send("follow");
  for (int i = 0; i < 100; ++i) {
    generator.write("nAxesReferencePosition", Vector{4.0, 4.0});
    cycle();
  }
  EXPECT_NEAR(velocity()[0], 1.0, 1e-6);
  cycle(9);
  EXPECT_EQ(follow.stage(), CommandStage::kAccepted);
  cycle(3);
  EXPECT_EQ(follow.stage(), CommandStage::kFailed);
  EXPECT_THAT(follow.reason(), HasSubstr("fell silent"));
  cycle(62);
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_LT(desired()[0], 2.0);
}

TEST_F(OnlineGenerator, ResetPositionBrakesFromTheMeasuredPosition) {
  start_at({0.0, 0.0});
  auto motion = generator.send("moveTo", Vector{4.0, 4.0}, 0.0);
  cycle(100);
  measured = {0.5, 0.5};
  generator.write("nAxesSensorPosition", measured);
  EXPECT_TRUE(generator.call("resetPosition"));
  EXPECT_EQ(motion.stage(), CommandStage::kFailed);
  cycle(61);
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_NEAR(desired()[0], 0.5 + 0.3, 0.01);
}

}  // namespace
}  // namespace armature::controllers
