// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/bridge_ref/bridge_ref.hpp"

#include <chrono>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using ::testing::ElementsAre;

using Vector = std::vector<double>;

class Bridge : public ::testing::Test {
 protected:
  void start() {
    bridge.set("joints", 2);
    ASSERT_TRUE(bridge.start()) << bridge.reason();
  }
  const Vector& reference() { return bridge.output<Vector>("reference"); }

  testing::Harness bridge{std::make_unique<BridgeRef>("BridgeRef")};
};

TEST_F(Bridge, HandsTheMeasuredPositionsOn) {
  start();
  bridge.write("sensor", Vector{1.0, 2.0, 0.1, 0.2});
  EXPECT_THAT(bridge.output<Vector>("nAxesSensorPosition"), ElementsAre(1.0, 2.0));
  EXPECT_EQ(bridge.writes("reference"), 0u);
}

TEST_F(Bridge, ComposesTheReferenceOnceAllThreeVectorsCame) {
  start();
  bridge.write("nAxesDesiredAcceleration", Vector{5.0, 6.0});
  bridge.write("nAxesDesiredPosition", Vector{1.0, 2.0});
  EXPECT_EQ(bridge.writes("reference"), 0u);
  bridge.write("nAxesDesiredVelocity", Vector{3.0, 4.0});
  EXPECT_EQ(bridge.writes("reference"), 1u);
  EXPECT_THAT(reference(), ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
}

TEST_F(Bridge, NeverMixesTheVectorsOfTwoSteps) {
  start();
  for (const double step : {1.0, 2.0}) {
    bridge.write("nAxesDesiredPosition", Vector(2, step));
    bridge.write("nAxesDesiredVelocity", Vector(2, step));
    bridge.write("nAxesDesiredAcceleration", Vector(2, step));
    EXPECT_THAT(reference(), ::testing::Each(step));
  }
  EXPECT_EQ(bridge.writes("reference"), 2u);
}

TEST_F(Bridge, AStartForgetsTheHalfOfAReference) {
  start();
  bridge.write("nAxesDesiredPosition", Vector(2, 1.0));
  bridge.write("nAxesDesiredVelocity", Vector(2, 1.0));
  bridge.stop();
  ASSERT_TRUE(bridge.start()) << bridge.reason();
  bridge.write("nAxesDesiredAcceleration", Vector(2, 2.0));
  EXPECT_EQ(bridge.writes("reference"), 0u);
}

TEST_F(Bridge, HasNothingToSayForASilentGeneratorAndHandsTheSensorOn) {
  start();
  for (int i = 0; i < 20; ++i) {
    bridge.write("sensor", Vector(4, 0.0));
    bridge.write("nAxesDesiredVelocity", Vector(2, 1.0));
    bridge.write("nAxesDesiredAcceleration", Vector(2, 1.0));
    if (i == 0) bridge.write("nAxesDesiredPosition", Vector(2, 1.0));
    bridge.advance(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(bridge.state(), component::State::kRunning);
  EXPECT_EQ(bridge.writes("reference"), 1u);
  EXPECT_EQ(bridge.writes("nAxesSensorPosition"), 20u);
}

TEST_F(Bridge, TakesNoVectorOfAnotherSize) {
  start();
  EXPECT_THROW(bridge.write("sensor", Vector(2, 0.0)), std::invalid_argument);
}

}  // namespace
}  // namespace armature::controllers
