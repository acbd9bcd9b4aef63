// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/actuator_demux/actuator_demux.hpp"

#include <chrono>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using namespace std::chrono_literals;

class ActuatorDemux : public ::testing::Test {
 protected:
  void start(int joints = 2) {
    actuator.set("joints", joints);
    ASSERT_TRUE(actuator.start()) << actuator.reason();
  }
  void act(const std::vector<double>& signals) { actuator.write("act", signals); }
  double voltage(int joint) { return actuator.output<double>("Voltage" + std::to_string(joint)); }

  testing::Harness actuator{std::make_unique<ActuatorNDemux>("Actuator")};
};

TEST_F(ActuatorDemux, HandsOutAndThenHasAllJointsAct) {
  start();
  const auto& acts = actuator.record<>("Act");
  actuator.raise("Sample");
  EXPECT_EQ(acts.size(), 0u);
  act({1.5, -2.5});
  EXPECT_EQ(voltage(1), 1.5);
  EXPECT_EQ(voltage(2), -2.5);
  EXPECT_EQ(acts.size(), 1u);
}

TEST_F(ActuatorDemux, RaisesActOnlyIfASampleCameSinceTheLast) {
  start();
  const auto& acts = actuator.record<>("Act");
  act({1.0, 1.0});
  EXPECT_EQ(acts.size(), 0u);
  EXPECT_EQ(voltage(1), 1.0);
  actuator.raise("Sample");
  act({2.0, 2.0});
  act({3.0, 3.0});
  EXPECT_EQ(acts.size(), 1u);
  EXPECT_EQ(voltage(2), 3.0);
}

TEST_F(ActuatorDemux, CountsSamplesInWhichNothingWasDriven) {
  start();
  actuator.raise("Sample");
  actuator.raise("Sample");
  actuator.raise("Sample");
  EXPECT_EQ(actuator.get<int>("samples_without_act"), 2);
}

TEST_F(ActuatorDemux, HandsOutNothingIfASignalIsNoNumber) {
  start();
  const auto& acts = actuator.record<>("Act");
  actuator.raise("Sample");
  act({1.0, -std::numeric_limits<double>::infinity()});
  EXPECT_EQ(actuator.state(), component::State::kException);
  EXPECT_EQ(actuator.reason(), "the control signal of joint 2 is -inf, expected a finite number");
  EXPECT_EQ(actuator.writes("Voltage1"), 0u);
  EXPECT_EQ(acts.size(), 0u);
}

TEST_F(ActuatorDemux, StopsIfNothingComes) {
  start();
  act({1.0, 1.0});
  actuator.advance(100ms);
  EXPECT_EQ(actuator.state(), component::State::kRunning);
  actuator.advance(1ms);
  EXPECT_EQ(actuator.state(), component::State::kStopped);
  EXPECT_EQ(actuator.reason(), "input 'act': its data is older than declared");
}

TEST_F(ActuatorDemux, TakesNoVectorOfAnotherSize) {
  start();
  EXPECT_THROW(act({1.0, 2.0, 3.0}), std::invalid_argument);
}

TEST_F(ActuatorDemux, IsForAnyNumberOfJoints) {
  start(1000);
  act(std::vector<double>(1000, 0.5));
  EXPECT_EQ(voltage(1000), 0.5);
}

}  // namespace
}  // namespace armature::controllers
