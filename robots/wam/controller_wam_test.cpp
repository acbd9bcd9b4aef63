// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/controller_wam.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"
#include "armature/testing/realtime_guard.hpp"
#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

class ControllerWamTest : public ::testing::Test {
 protected:
  ControllerWamTest() {
    controller.set("joints", 4);
    controller.set("Period", kPeriod);
  }
  void start() { ASSERT_TRUE(controller.start()) << controller.reason(); }
  void desire(const Vector& positions) {
    Vector reference = positions;
    reference.resize(12, 0.0);
    controller.write("reference", reference);
  }
  void measure(const Vector& positions) {
    Vector sensor = positions;
    sensor.resize(8, 0.0);
    controller.write("sensor", sensor);
  }
  const Vector& act() { return controller.output<Vector>("act"); }

  testing::Harness controller{std::make_unique<ControllerWam>("Controller")};
};

TEST_F(ControllerWamTest, HasTheVendorsGainsForSoManyJoints) {
  start();
  desire({0.0, 0.0, 0.0, 0.001});
  measure({0.0, 0.0, 0.0, 0.0});
  EXPECT_NEAR(act()[3], 500 * 0.001 + 0.5 * kPeriod * 0.001, 1e-12) << "it does not kick";
  measure({0.0, 0.0, 0.0, 0.0005});
  const double change = -0.0005 / kPeriod;
  EXPECT_NEAR(act()[3], 500 * 0.0005 + 0.5 * kPeriod * 0.002 + 2.5 * change, 1e-12);
}

TEST_F(ControllerWamTest, TakesOtherGains) {
  controller.set("Kp", "[10]");
  controller.set("Ki", "[0]");
  controller.set("Kd", "[0]");
  controller.set("MaxTorque", "[1, 2, 3, 4]");
  start();
  desire({1.0, 1.0, 1.0, 0.1});
  measure({0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(act(), Vector({1.0, 2.0, 3.0, 1.0}));
}

TEST_F(ControllerWamTest, AStartIsWithoutAPast) {
  start();
  desire({0.001, 0.0, 0.0, 0.0});
  measure({0.0, 0.0, 0.0, 0.0});
  const double first = act()[0];
  measure({0.0, 0.0, 0.0, 0.0});
  controller.stop();
  start();
  desire({0.001, 0.0, 0.0, 0.0});
  measure({0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(act()[0], first);
}

TEST_F(ControllerWamTest, ANumberThatIsNotFiniteIsAFault) {
  start();
  desire({std::nan(""), 0.0, 0.0, 0.0});
  measure({0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(controller.state(), component::State::kException);
  EXPECT_EQ(controller.writes("act"), 0u);
}

TEST_F(ControllerWamTest, RefusesGainsOfAnotherNumberOfJoints) {
  controller.set("Ki", "[1, 2]");
  EXPECT_FALSE(controller.start());
  EXPECT_EQ(controller.reason(),
            "Ki: found 2 numbers, expected 4, one for each joint, or one for all");
}

TEST_F(ControllerWamTest, BreaksNoRuleOfRealTime) {
  start();
  const testing::RealtimeGuard guard;
  for (int i = 0; i < 100; ++i) {
    desire({0.001 * i, 0.0, 0.0, 0.0});
    measure({0.0, 0.0, 0.0, 0.0});
  }
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

}  // namespace
}  // namespace armature::wam
