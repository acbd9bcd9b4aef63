// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/arming/arming.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::HasSubstr;

class ArmingTest : public ::testing::Test {
 protected:
  ArmingTest() {
    arming.set("joints", 2);
    settles = &arming.record<>("Settle");
    arms = &arming.record<>("Arm");
    disarms = &arming.record<>("Disarm");
    stops = &arming.record<>("Stop");
  }
  void start() {
    ASSERT_TRUE(arming.start()) << arming.reason();
    arming.write<bool>("Armed1", false);
    arming.write<bool>("Armed2", false);
    measure(1.0, 2.0);
  }
  void measure(double q1, double q2) {
    arming.write("nAxesSensorPosition", std::vector<double>{q1, q2});
  }
  void desire(double q1, double q2, double velocity2 = 0.0) {
    arming.write("nAxesDesiredPosition", std::vector<double>{q1, q2});
    arming.write("nAxesDesiredVelocity", std::vector<double>{0.0, velocity2});
  }
  void say_armed(bool first, bool second) {
    arming.write("Armed1", first);
    arming.write("Armed2", second);
    arming.run_cycles();
  }
  component::CommandHandle arm() {
    auto handle = arming.send("arm");
    arming.run_cycles();
    return handle;
  }
  void get_armed() {
    auto command = arm();
    desire(1.0, 2.0);
    arming.run_cycles();
    say_armed(true, true);
    ASSERT_EQ(command.stage(), CommandStage::kDone) << command.reason();
    ASSERT_TRUE(arming.get<bool>("armed"));
  }

  testing::Harness arming{std::make_unique<Arming>("Arming"), 10ms};
  const std::vector<std::tuple<>>* settles;
  const std::vector<std::tuple<>>* arms;
  const std::vector<std::tuple<>>* disarms;
  const std::vector<std::tuple<>>* stops;
};

TEST_F(ArmingTest, NothingIsArmedWithoutTheCommand) {
  start();
  desire(1.0, 2.0);
  arming.run_cycles(200);
  EXPECT_TRUE(settles->empty());
  EXPECT_TRUE(arms->empty());
  EXPECT_FALSE(arming.get<bool>("armed"));
}

TEST_F(ArmingTest, SettlesThenArmsThenWaitsForTheJoints) {
  start();
  auto command = arm();
  EXPECT_EQ(settles->size(), 1u);
  EXPECT_TRUE(arms->empty());
  desire(1.0, 2.0);
  arming.run_cycles();
  EXPECT_EQ(arms->size(), 1u);
  EXPECT_FALSE(command.ended());
  say_armed(true, false);
  EXPECT_FALSE(command.ended());
  say_armed(true, true);
  EXPECT_EQ(command.stage(), CommandStage::kDone);
  EXPECT_TRUE(arming.get<bool>("armed"));
  EXPECT_TRUE(disarms->empty());
}

TEST_F(ArmingTest, AReferenceFromBeforeSettleDoesNotCount) {
  start();
  desire(1.0, 2.0);
  auto command = arm();
  arming.run_cycles(50);
  EXPECT_TRUE(arms->empty());
  EXPECT_FALSE(command.ended());
}

TEST_F(ArmingTest, FailsIfTheReferenceIsElsewhereAndNamesTheJoint) {
  start();
  auto command = arm();
  for (int k = 0; k < 150 && !command.ended(); ++k) {
    desire(1.0, 2.5);
    arming.run_cycles();
  }
  EXPECT_EQ(command.stage(), CommandStage::kFailed);
  EXPECT_EQ(command.reason(), "joint 2 is at 2 rad, its reference at 2.5 rad");
  EXPECT_TRUE(arms->empty());
  EXPECT_EQ(disarms->size(), 1u);
}

TEST_F(ArmingTest, AReferenceThatMovesIsNotAtRest) {
  start();
  auto command = arm();
  desire(1.0, 2.0, 0.1);
  arming.run_cycles();
  EXPECT_TRUE(arms->empty());
  desire(1.0, 2.0, 0.0);
  arming.run_cycles();
  EXPECT_EQ(arms->size(), 1u);
}

TEST_F(ArmingTest, FailsIfAJointDoesNotArmAndDisarmsAll) {
  start();
  auto command = arm();
  desire(1.0, 2.0);
  arming.run_cycles();
  say_armed(true, false);
  arming.run_cycles(550);
  EXPECT_EQ(command.stage(), CommandStage::kFailed);
  EXPECT_THAT(std::string(command.reason()), HasSubstr("did not arm"));
  EXPECT_EQ(disarms->size(), 1u);
  EXPECT_FALSE(arming.get<bool>("armed"));
}

TEST_F(ArmingTest, FailsAtOnceWithTheReasonOfAJoint) {
  start();
  auto command = arm();
  desire(1.0, 2.0);
  arming.run_cycles();
  const auto told = arming.call("notArmed", ComponentName("Joint2"), component::Reason("it fell"));
  ASSERT_TRUE(told) << told.error();
  arming.run_cycles();
  EXPECT_EQ(command.stage(), CommandStage::kFailed);
  EXPECT_EQ(command.reason(), "Joint2 is not armed: it fell");
  EXPECT_EQ(disarms->size(), 1u);
  ASSERT_TRUE(arming.call("notArmed", ComponentName("Joint1"), component::Reason("late")));
  EXPECT_EQ(disarms->size(), 1u);
}

TEST_F(ArmingTest, SaysWhenTheArmedJointsAreToStandAndWhenNot) {
  const auto* rests = &arming.record<>("Rest");
  const auto* motions = &arming.record<>("Motion");
  start();
  get_armed();
  EXPECT_TRUE(rests->empty());
  arming.run_cycles(20);
  EXPECT_EQ(rests->size(), 1u);
  desire(1.0, 2.0, 0.1);
  arming.run_cycles();
  EXPECT_EQ(motions->size(), 1u);
  desire(1.0, 2.001);
  arming.run_cycles(5);
  desire(1.0, 2.002);
  arming.run_cycles(9);
  EXPECT_EQ(rests->size(), 1u) << "what changes does not rest";
  arming.run_cycles(5);
  EXPECT_EQ(rests->size(), 2u);
  EXPECT_EQ(motions->size(), 1u);
}

TEST_F(ArmingTest, RefusesBeforeAnythingWasMeasuredAndWhenArmed) {
  ASSERT_TRUE(arming.start()) << arming.reason();
  EXPECT_THAT(std::string(arm().reason()), HasSubstr("nothing is measured yet"));
  measure(1.0, 2.0);
  get_armed();
  EXPECT_THAT(std::string(arm().reason()), HasSubstr("armed already"));
}

TEST_F(ArmingTest, DisarmIsAtOnce) {
  start();
  get_armed();
  ASSERT_TRUE(arming.call("disarm"));
  EXPECT_EQ(disarms->size(), 1u);
  EXPECT_FALSE(arming.get<bool>("armed"));
}

TEST_F(ArmingTest, DisarmEndsAnArming) {
  start();
  auto command = arm();
  ASSERT_TRUE(arming.call("disarm"));
  EXPECT_EQ(command.stage(), CommandStage::kFailed);
  desire(1.0, 2.0);
  arming.run_cycles(5);
  EXPECT_TRUE(arms->empty());
}

TEST_F(ArmingTest, IfOneJointIsDisarmedAllAre) {
  start();
  get_armed();
  say_armed(true, false);
  EXPECT_EQ(disarms->size(), 1u);
  EXPECT_FALSE(arming.get<bool>("armed"));
}

TEST_F(ArmingTest, StopIsAMotionAndLeavesTheJointsArmed) {
  start();
  get_armed();
  ASSERT_TRUE(arming.call("stop"));
  EXPECT_EQ(stops->size(), 1u);
  EXPECT_TRUE(disarms->empty());
  EXPECT_TRUE(arming.get<bool>("armed"));
}

TEST_F(ArmingTest, AStopBeforeAllAreArmedDisarms) {
  start();
  const std::size_t before = disarms->size();
  ASSERT_TRUE(arming.call("stop"));
  EXPECT_EQ(disarms->size(), before + 1) << "a joint may home";
  auto command = arm();
  ASSERT_TRUE(arming.call("stop"));
  EXPECT_EQ(disarms->size(), before + 2);
  EXPECT_EQ(command.stage(), CommandStage::kFailed);
  desire(1.0, 2.0);
  arming.run_cycles(200);
  EXPECT_TRUE(arms->empty());
}

TEST_F(ArmingTest, AStopOfTheComponentDisarms) {
  start();
  get_armed();
  arming.stop();
  EXPECT_EQ(disarms->size(), 1u);
  ASSERT_TRUE(arming.start()) << arming.reason();
  EXPECT_FALSE(arming.get<bool>("armed"));
}

}  // namespace
}  // namespace armature::controllers
