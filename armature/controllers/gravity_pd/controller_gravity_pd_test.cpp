// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/gravity_pd/controller_gravity_pd.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::controllers {
namespace {

using Vector = std::vector<double>;
constexpr double kPeriod = 0.002;

class GravityPd : public ::testing::Test {
 protected:
  GravityPd() {
    controller.set("joints", 2);
    controller.set("robot_description", std::string_view(TESTDATA "/pan_tilt.urdf"));
    controller.set("Period", kPeriod);
    controller.set("Kp", "[10, 20]");
    controller.set("Kd", "[1]");
  }
  void start() { ASSERT_TRUE(controller.start()) << controller.reason(); }
  const Vector& act() { return controller.output<Vector>("act"); }

  testing::Harness controller{std::make_unique<ControllerGravityPD>("Controller")};
};

TEST_F(GravityPd, HoldsTheWeightAndPullsToTheReference) {
  start();
  controller.write("reference", Vector{0.2, 0.7, 0.0, 0.5, 3.0, 2.0});
  controller.raise("Sample");
  controller.write("sensor", Vector{0.3, 0.65, 0.0, 0.1 * kPeriod});
  EXPECT_NEAR(act()[0], 10.0 * (0.2 - 0.3), 1e-12);
  EXPECT_NEAR(act()[1], 1.1 * 9.81 * 0.08 * std::cos(0.65) + 20.0 * 0.05 + (0.5 - 0.1), 1e-12);
}

TEST_F(GravityPd, WhereTheHardwareHoldsTheWeightGravityIsNone) {
  controller.set("gravity", "[0, 0, 0]");
  start();
  controller.write("reference", Vector{0.0, 0.7, 0.0, 0.0, 0.0, 0.0});
  controller.raise("Sample");
  controller.write("sensor", Vector{0.0, 0.7, 0.0, 0.0});
  EXPECT_NEAR(act()[1], 0.0, 1e-12);
}

TEST_F(GravityPd, RefusesGainsOfAnotherNumberOfJoints) {
  controller.set("Kp", "[1, 2, 3]");
  EXPECT_FALSE(controller.start());
  EXPECT_EQ(controller.reason(),
            "Kp: found 3 numbers, expected 2, one for each joint, or one for all");
}

TEST_F(GravityPd, StopsWithoutAReferenceThatIsYoungEnough) {
  start();
  controller.write("reference", Vector{0.0, 0.7, 0.0, 0.0, 0.0, 0.0});
  controller.raise("Sample");
  controller.write("sensor", Vector{0.0, 0.7, 0.0, 0.0});
  for (int i = 0; i < 11; ++i) {
    controller.advance(std::chrono::milliseconds(10));
    controller.raise("Sample");
    controller.write("sensor", Vector{0.0, 0.7, 0.0, 0.0});
  }
  EXPECT_EQ(controller.state(), component::State::kStopped);
}

}  // namespace
}  // namespace armature::controllers
