// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/wheel.hpp"

#include <chrono>
#include <memory>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;
using component::State;

struct WheelTest : public ::testing::Test {
  WheelTest() {
    wheel.set("Number", 2);
    wheel.serve<WheelSample(int)>("readWheel", [this](int number) {
      EXPECT_EQ(number, 2);
      return says;
    });
    wheel.serve<bool(int, control::LimitedEffort)>("setWheel", [this](int, control::LimitedEffort) {
      ++told;
      return true;
    });
    wheel.serve<bool(int, control::DrivePermit)>(
        "wheelOn", [](int, control::DrivePermit permit) { return static_cast<bool>(permit); });
    wheel.serve<bool(int)>("wheelOff", [this](int) {
      ++switched_off;
      return true;
    });
  }

  WheelSample says{.counts = 500, .fresh = true, .on = false};
  int told = 0;
  int switched_off = 0;
  testing::Harness wheel{std::make_unique<Wheel>("Wheel2")};
};

TEST_F(WheelTest, TellsWhatTheMotorTurned) {
  ASSERT_TRUE(wheel.start()) << wheel.reason();
  EXPECT_TRUE(wheel.call<bool>("sensorRead").value());
  EXPECT_DOUBLE_EQ(wheel.output<double>("DisplacementSensor"), 0.5 * std::numbers::pi);
}

TEST_F(WheelTest, ASilentEncoderIsNoMeasurement) {
  says.fresh = false;
  ASSERT_TRUE(wheel.start()) << wheel.reason();
  EXPECT_FALSE(wheel.call<bool>("sensorRead").value());
  EXPECT_EQ(wheel.writes("DisplacementSensor"), 0U);
  EXPECT_EQ(wheel.state(), State::kRunning);
}

TEST_F(WheelTest, IsOffWheneverItStops) {
  ASSERT_TRUE(wheel.start()) << wheel.reason();
  wheel.stop();
  EXPECT_GT(switched_off, 0);
  EXPECT_GT(told, 0) << "effort 0";
}

TEST_F(WheelTest, NobodyWithoutAPermitSwitchesItOn) {
  ASSERT_TRUE(wheel.start()) << wheel.reason();
  EXPECT_FALSE(wheel.call<bool>("actuatorOn", control::DrivePermit{})) << "it is sealed";
}

}  // namespace
}  // namespace armature::rover
