// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/controllers/internal/test_generator.hpp"
#include "armature/exec/application.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;
using component::CommandStage;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(AxesGenerator, TheReferenceIsTheMeasuredPositionBeforeTheFirstMotion) {
  start_at({0.25, 0.5});
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
  EXPECT_THAT(velocity(), Each(0.0));
  measured = {0.3, 0.4};  // the joints give way: the reference stays
  cycle(3);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
  EXPECT_EQ(generator.writes("nAxesDesiredAcceleration"), 4u);
}

TEST_F(AxesGenerator, WritesNothingBeforeAnythingWasMeasured) {
  ASSERT_TRUE(generator.start()) << generator.reason();
  generator.run_cycles(3);
  EXPECT_EQ(generator.writes("nAxesDesiredPosition"), 0u);
  EXPECT_EQ(refusal_of({1.0, 1.0}, 1.0),
            "the positions of the axes are not known yet: try again in the next cycle");
}

TEST_F(AxesGenerator, AllAxesBeginAndEndTogetherInTheAskedTime) {
  start_at({0.25, 0.5});
  auto motion = generator.send("moveTo", Vector{1.25, 1.0}, 4.0);
  EXPECT_EQ(motion.stage(), CommandStage::kAccepted);
  cycle(200);
  EXPECT_NEAR(motion.progress(), 0.5, 1e-9);
  EXPECT_NEAR(desired()[0], 0.75, 1e-9);
  EXPECT_NEAR(desired()[1], 0.75, 1e-9);
  EXPECT_GT(velocity()[0], 0.0);
  cycle(199);
  EXPECT_EQ(motion.stage(), CommandStage::kAccepted);
  EXPECT_NE(velocity()[0], 0.0);
  EXPECT_NE(velocity()[1], 0.0);
  cycle();
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_THAT(desired(), ElementsAre(1.25, 1.0));
  EXPECT_THAT(velocity(), Each(0.0));
  EXPECT_THAT(acceleration(), Each(0.0));
}

TEST_F(AxesGenerator, AskedForNoTimeItIsAsFastAsTheLimitsAllow) {
  start_at({0.0, 0.0});
  // 2 rad at 1 rad/s and 2 rad/s^2: 2 s and half a second for the ramps.
  auto motion = generator.send("moveTo", Vector{2.0, 0.5}, 0.0);
  double fastest = 0.0;
  int cycles = 0;
  for (; motion.stage() == CommandStage::kAccepted && cycles < 1000; ++cycles) {
    cycle();
    fastest = std::max({fastest, std::abs(velocity()[0]), std::abs(velocity()[1])});
    EXPECT_LE(std::abs(acceleration()[0]), 2.0 + 1e-9);
  }
  EXPECT_EQ(cycles, 250);
  EXPECT_NEAR(fastest, 1.0, 1e-9);
}

TEST_F(AxesGenerator, RefusesWhatCannotBeWithTheReasonAndNothingMoves) {
  start_at({0.25, 0.5});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal_of({1.0}, 1.0), "expected one number for each axis: expected 2, found 1");
  EXPECT_EQ(refusal_of({1.0, 5.0}, 1.0),
            "axis 2: a target is outside the limits of its axis: 5, expected -0.5 to 4.5");
  EXPECT_EQ(refusal_of({nan, 1.0}, 1.0), "axis 1: a number is not finite: nan");
  EXPECT_EQ(refusal_of({1.0, 1.0}, inf), "a number is not finite: the time is inf");
  EXPECT_EQ(refusal_of({1.0, 1.0}, -1.0), "the time is negative: -1");
  EXPECT_EQ(refusal_of({2.25, 1.0}, 2.4),
            "the motion is faster than the limits allow: it takes 2.5 s at least, found 2.4 s (0 "
            "asks for the shortest)");
  cycle(10);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
  EXPECT_EQ(generator.state(), component::State::kRunning);
}

TEST_F(AxesGenerator, ATimeThatTheLimitsJustAllowIsAccepted) {
  start_at({0.25, 0.5});
  EXPECT_EQ(refusal_of({2.25, 1.0}, 2.5), "accepted");
}

TEST_F(OfAnArmedRobot, MotionsAreRefusedUntilItIsArmedAndOnceItIsDisarmed) {
  EXPECT_EQ(refusal_of({1.0, 1.0}, 2.0), "the robot is not armed: arm first");
  armed = true;
  EXPECT_EQ(refusal_of({1.0, 1.0}, 2.0), "accepted");
  armed = false;
  generator.raise("Disarm");
  cycle();
  EXPECT_EQ(refusal_of({1.0, 1.0}, 2.0), "the robot is not armed: arm first");
  cycle(10);
  EXPECT_THAT(desired(), ElementsAre(0.25, 0.5));
}

/// An Arming that cannot be asked, and where the axes are.
class Elsewhere final : public component::Component {
 public:
  using Component::Component;
  component::Event<> arm{this, "Arm", "", component::occasional};
  component::Event<> disarm{this, "Disarm", "", component::occasional};
  component::OutputPort<Vector> measured{this, "Measured", "", "rad", component::fixed_size(2)};
  bool arms = false;

 private:
  void on_update() override {
    measured.write(there_);
    static_cast<void>(arms ? arm.raise() : disarm.raise());
  }
  const Vector there_{0.25, 0.5};
};

TEST(AxesGeneratorWithEvents, BelievesAnArmingThatCannotBeAskedItsEvents) {
  exec::Blueprint blueprint;
  auto& elsewhere = blueprint.add<Elsewhere>("Elsewhere", exec::Activity::periodic(10ms));
  auto& generator = blueprint.add<AxesGeneratorPos>("Generator", exec::Activity::periodic(10ms));
  blueprint.connect("Elsewhere.Measured", "Generator.nAxesSensorPosition");
  blueprint.add_peer("Generator", "Elsewhere");
  exec::ApplicationOptions options;
  options.simulated = true;
  exec::Application application(std::move(blueprint), std::move(options));
  for (component::PropertyBase* property : component::interface_of(generator).properties) {
    static constexpr std::string_view kOthers[] = {"Unit", "progress", "remaining_time"};
    if (std::ranges::find(kOthers, property->name()) != std::end(kOthers)) continue;
    const bool axes = property->name() == "num_axes";
    const double limit = property->name() == "lower" ? -0.5 : 4.5;
    ASSERT_TRUE(property->set(axes ? types::Value::of(2) : types::Value::of(Vector{limit})));
  }
  ASSERT_EQ(application.start().to_text(), "");
  application.run_for(50ms);
  const auto move = [&] {
    return application.call("Generator", "moveTo",
                            {types::Value::of(Vector{1.0, 1.0}), types::Value::of(2.0)});
  };
  const auto refused = move();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("the robot is not armed: arm first"));
  elsewhere.arms = true;
  application.run_for(20ms);
  EXPECT_TRUE(move());
}

/// A peer that allows the fastest axis half of its velocity.
class WithALimitOfAPeer : public AxesGenerator {
 protected:
  WithALimitOfAPeer() {
    generator.serve<double(const Vector&, const Vector&)>(
        "motionLimitUsed", [](const Vector&, const Vector& velocities) {
          return 2.0 * std::max(std::abs(velocities[0]), std::abs(velocities[1]));
        });
    start_at({0.25, 0.5});
  }
};

TEST_F(WithALimitOfAPeer, RefusesWhatIsFasterAndSaysTheShortestTime) {
  // 2 rad in 2.5 s reach 1 rad/s, in 5 s half of that.
  EXPECT_EQ(refusal_of({2.25, 1.0}, 3.0),
            "the motion is faster than the limits allow: it takes 5 s at least, found 3 s (0 asks "
            "for the shortest)");
  EXPECT_EQ(refusal_of({2.25, 1.0}, 5.0), "accepted");
}

TEST_F(WithALimitOfAPeer, AskedForNoTimeItKeepsWithinThatToo) {
  auto motion = generator.send("moveTo", Vector{2.25, 1.0}, 0.0);
  double fastest = 0.0;
  int cycles = 0;
  for (; motion.stage() == CommandStage::kAccepted && cycles < 1000; ++cycles) {
    cycle();
    fastest = std::max(fastest, std::abs(velocity()[0]));
  }
  EXPECT_EQ(cycles, 500);
  EXPECT_NEAR(fastest, 0.5, 1e-9);
}

TEST_F(AxesGenerator, TellsHowFarAMotionIsAndHowLongItStillTakes) {
  start_at({0.0, 0.0});
  EXPECT_EQ(generator.get<double>("progress"), 1.0);
  auto motion = generator.send("moveTo", Vector{1.0, 1.0}, 4.0);
  cycle(100);
  EXPECT_NEAR(generator.get<double>("progress"), 0.25, 1e-6);
  EXPECT_NEAR(generator.get<double>("remaining_time"), 3.0, 1e-6);
  EXPECT_NEAR(motion.progress(), 0.25, 1e-6);
  cycle(300);
  EXPECT_EQ(generator.get<double>("progress"), 1.0);
  EXPECT_EQ(generator.get<double>("remaining_time"), 0.0);
}

TEST_F(AxesGenerator, CancellingIsASmoothStopWhereItThenHolds) {
  start_at({0.0, 0.0});
  auto motion = generator.send("moveTo", Vector{4.0, 2.0}, 0.0);
  cycle(150);
  ASSERT_NEAR(velocity()[0], 1.0, 1e-9);
  const double began = desired()[0];
  motion.cancel();
  double largest_step = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double before = velocity()[0];
    cycle();
    largest_step = std::max(largest_step, std::abs(velocity()[0] - before));
  }
  EXPECT_EQ(motion.stage(), CommandStage::kCancelled);
  EXPECT_LE(largest_step, 2.0 * 0.010 + 1e-9);
  EXPECT_NEAR(desired()[0] - began, 0.25, 0.011);  // v^2 / (2 a)
  EXPECT_THAT(velocity(), Each(0.0));
  const Vector rest = desired();
  cycle(10);
  EXPECT_EQ(desired(), rest);
  EXPECT_EQ(refusal_of({1.0, 1.0}, 0.0), "accepted");
}

TEST_F(AxesGenerator, ResetPositionAtRestTakesTheMeasuredPosition) {
  start_at({0.25, 0.5});
  measured = {0.3, 0.45};
  cycle();
  ASSERT_TRUE(generator.call("resetPosition"));
  cycle();
  EXPECT_THAT(desired(), ElementsAre(0.3, 0.45));
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(AxesGenerator, ResetPositionDuringAMotionBrakesFromTheMeasuredPosition) {
  start_at({0.0, 0.0});
  auto motion = generator.send("moveTo", Vector{4.0, 4.0}, 0.0);
  cycle(150);
  measured = {0.9, 0.8};
  generator.write("nAxesSensorPosition", measured);
  ASSERT_TRUE(generator.call("resetPosition"));
  EXPECT_EQ(motion.stage(), CommandStage::kFailed);
  EXPECT_EQ(motion.reason(), "resetPosition stopped the motion");
  cycle();
  EXPECT_NEAR(velocity()[0], 1.0 - 2.0 * 0.010, 1e-9);
  EXPECT_NEAR(desired()[0], 0.9 + 0.010, 1e-3);
  cycle(60);
  EXPECT_NEAR(desired()[0], 0.9 + 0.25, 1e-9);
  EXPECT_NEAR(desired()[1], 0.8 + 0.25, 1e-9);
  EXPECT_THAT(velocity(), Each(0.0));
}

TEST_F(AxesGenerator, AfterAStopTheReferenceIsWhatIsMeasured) {
  start_at({0.0, 0.0});
  auto motion = generator.send("moveTo", Vector{4.0, 4.0}, 0.0);
  cycle(100);
  generator.stop();
  EXPECT_EQ(motion.stage(), CommandStage::kCancelled);
  start_at({0.2, 0.3});
  EXPECT_THAT(desired(), ElementsAre(0.2, 0.3));
  cycle(10);
  EXPECT_THAT(desired(), ElementsAre(0.2, 0.3));
}

TEST_F(AxesGenerator, WhatWasMeasuredBeforeAStartIsNotTheReference) {
  start_at({0.1, 0.2});
  generator.stop();
  generator.advance(10ms);
  ASSERT_TRUE(generator.start()) << generator.reason();
  const auto writes = generator.writes("nAxesDesiredPosition");
  generator.run_cycles(2);
  EXPECT_EQ(generator.writes("nAxesDesiredPosition"), writes);
  EXPECT_EQ(refusal_of({1.0, 1.0}, 1.0),
            "the positions of the axes are not known yet: try again in the next cycle");
  measured = {0.3, 0.4};
  cycle();
  EXPECT_THAT(desired(), ElementsAre(0.3, 0.4));
}

TEST_F(AxesGenerator, FaultsIfTheMeasuredPositionIsNoNumber) {
  ASSERT_TRUE(generator.start()) << generator.reason();
  generator.write("nAxesSensorPosition", Vector{0.0, std::numeric_limits<double>::infinity()});
  generator.run_cycles();
  EXPECT_EQ(generator.state(), component::State::kException);
  EXPECT_EQ(generator.reason(), "nAxesSensorPosition of axis 2 is inf, expected a finite number");
  EXPECT_EQ(generator.writes("nAxesDesiredPosition"), 0u);
}

TEST_F(AxesGenerator, StopsIfNothingIsMeasuredAnyMore) {
  start_at({0.25, 0.5});
  generator.advance(101ms);
  EXPECT_EQ(generator.state(), component::State::kStopped);
}

TEST_F(AxesGenerator, RefusesLimitsThatCannotBe) {
  generator.set("max_vel", "[1.0, 2.0, 3.0]");
  EXPECT_FALSE(generator.start());
  EXPECT_EQ(generator.reason(),
            "max_vel: found 3 numbers, expected 2, one for each joint, or one for all");
  generator.set("max_vel", "[1.0, 0.0]");
  EXPECT_FALSE(generator.start());
  EXPECT_THAT(generator.reason(), HasSubstr("axes[1].max_velocity is 0"));
}

TEST_F(AxesGenerator, ALimitThatChangedWhileItWasStoppedCounts) {
  start_at({0.25, 0.5});
  generator.stop();
  generator.set("upper", "[1.0]");
  start_at({0.25, 0.5});
  EXPECT_THAT(refusal_of({2.0, 0.5}, 1.0), HasSubstr("outside the limits"));
}

TEST_F(AxesGenerator, MovesAThousandAxes) {
  set_limits(1000);
  start_at(Vector(1000, 0.0));
  auto motion = generator.send("moveTo", Vector(1000, 0.5), 1.0);
  cycle(100);
  EXPECT_EQ(motion.stage(), CommandStage::kDone);
  EXPECT_THAT(desired(), Each(0.5));
}

}  // namespace
}  // namespace armature::controllers
