// SPDX-License-Identifier: Apache-2.0
// What becomes of a moving head when something breaks: each is found in time, the head comes to
// rest, nobody but the operator lets it move again.
#include <functional>

#include <gmock/gmock.h>

#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class Fault : public ::testing::TestWithParam<const char*> {
 protected:
  Fault() : robot("pid.yaml", {std::string("mode=") + GetParam()}) {
    robot.start_armed();
    EXPECT_EQ(robot.move_to({3.0, 3.0}, 6.0), "");
    robot.run_for(2s);
  }
  SimulatedJanus& janus() {
    return *static_cast<SimulatedJanus*>(robot.application().find("Cards"));
  }
  Simulation& simulation() { return janus().simulation(); }
  bool on(std::size_t joint) { return simulation().card(joint).state() == AicState::kOn; }
  double position(std::size_t joint) { return janus().position(joint); }
  /// Both motors are off within that time, and the head comes to rest.
  void expect_off_within(base::Duration time) {
    robot.run_for(time);
    EXPECT_FALSE(on(0));
    EXPECT_FALSE(on(1));
    robot.run_for(1s);
    const Vector rest{position(0), position(1)};
    robot.run_for(2s);
    EXPECT_NEAR(position(0), rest[0], 1e-6);
    EXPECT_NEAR(position(1), rest[1], 2e-3);
    EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
  }

  Robot robot;
};

TEST_P(Fault, OneMissingAnswerIsCountedAndTheMotionGoesOn) {
  simulation().bus().lose_next(1, can::Filter{.id = 0x182, .mask = 0x7ff});
  robot.run_for(6s);
  EXPECT_EQ(robot.value<int>("Cards", "lost_answers"), 1);
  EXPECT_EQ(robot.value<int>("Sensor", "incomplete_rounds"), 1);
  EXPECT_FALSE(robot.value<bool>("AIC2", "position_exact"));
  EXPECT_TRUE(robot.value<bool>("AIC1", "position_exact"));
  EXPECT_TRUE(robot.value<bool>("Arming", "armed"));
  EXPECT_NEAR(position(0), 3.0, 1e-3);
  EXPECT_NEAR(position(1), 3.0, 0.02) << "less what the lost report had";
}

TEST_P(Fault, ASampleThatWasLostForGoodRefusesArmingUntilTheOperatorHasLooked) {
  simulation().bus().lose_next(1, can::Filter{.id = 0x182, .mask = 0x7ff});
  robot.run_for(7s);
  ASSERT_EQ(robot.call("Arming", "disarm"), "");
  robot.run_for(2s);
  robot.call("Arming", "arm");
  robot.run_for(3s);
  EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
  robot.arm();  // he looks
  EXPECT_TRUE(robot.value<bool>("AIC2", "position_exact"));
}

TEST_P(Fault, WhatAToolSaysOfTheCardsPositionIsNotTheOperatorsWord) {
  simulation().bus().lose_next(1, can::Filter{.id = 0x182, .mask = 0x7ff});
  robot.run_for(7s);
  ASSERT_EQ(robot.call("Arming", "disarm"), "");
  robot.run_for(2s);
  ASSERT_TRUE(robot.application().stop_component("AIC2"));
  ASSERT_TRUE(robot.application().set_property("AIC2", "position_exact", types::Value::of(true)));
  ASSERT_TRUE(robot.application().start_component("AIC2"));
  robot.run_for(1s);
  robot.call("Arming", "arm");
  robot.run_for(3s);
  EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
  EXPECT_FALSE(robot.value<bool>("AIC2", "position_exact"));
  robot.arm();  // now he looks
  EXPECT_TRUE(robot.value<bool>("Arming", "armed"));
}

TEST_P(Fault, WhatTheOperatorConfirmedBeforeASampleWasLostIsVoid) {
  ASSERT_TRUE(
      robot.application().set_property("AIC2", "position_confirmed", types::Value::of(true)));
  simulation().bus().lose_next(1, can::Filter{.id = 0x182, .mask = 0x7ff});
  robot.run_for(7s);
  ASSERT_EQ(robot.call("Arming", "disarm"), "");
  robot.run_for(2s);
  robot.call("Arming", "arm");
  robot.run_for(3s);
  EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
}

TEST_P(Fault, ASilentCardStopsBothJointsAndIsNamed) {
  simulation().bus().lose_next(1000, can::Filter{.id = 0x182, .mask = 0x7ff});
  expect_off_within(150ms);
  EXPECT_EQ(robot.state("Sensor"), State::kException);
  EXPECT_THAT(robot.reason("Sensor"), HasSubstr("Joint2"));
}

TEST_P(Fault, AUnpluggedBusStopsBothJoints) {
  simulation().bus().set_cut(true);
  expect_off_within(150ms);
}

TEST_P(Fault, BusOffIsFoundInTheCycleAndNamed) {
  janus().station().force_bus_off();
  robot.run_for(20ms);
  EXPECT_EQ(robot.state("AIC1"), State::kException);
  EXPECT_THAT(robot.reason("AIC1"), HasSubstr("the bus of the card is gone"));
  EXPECT_FALSE(robot.value<bool>("Joint1", "Armed"));
  expect_off_within(150ms);
}

TEST_P(Fault, ACardThatRestartsStopsBothJoints) {
  base::Diagnostics diagnostics;
  simulation().card(0).power_off();
  ASSERT_TRUE(simulation().card(0).power_on(diagnostics)) << diagnostics.to_text();
  expect_off_within(150ms);
  EXPECT_THAT(robot.reason("AIC1"),
              AnyOf(HasSubstr("restarted"), HasSubstr("switched its actuator off")));
}

INSTANTIATE_TEST_SUITE_P(Modes, Fault, ::testing::Values("synchronous", "sequential"),
                         [](const auto& mode) { return mode.param; });

}  // namespace
}  // namespace armature::janus
