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
  ControllerWamTest() { controller.set("joints", 4); }
  void start() { ASSERT_TRUE(controller.start()) << controller.reason(); }
  void desire(double first) {
    controller.write("reference", Vector{first, 2.0, 3.0, 4.0, 9.0, 9.0, 9.0, 9.0, 0, 0, 0, 0});
  }
  void measure() {
    controller.raise("Sample");
    controller.write("sensor", Vector(8, 0.0));
  }
  void answer(const Vector& torques) { controller.write("ControlData", torques); }

  testing::Harness controller{std::make_unique<ControllerWam>("Controller")};
};

TEST_F(ControllerWamTest, HasTheHardwareComputeTheTorquesAndHandsThemOn) {
  start();
  desire(1.0);
  measure();
  EXPECT_EQ(controller.output<Vector>("posRef"), Vector({1.0, 2.0, 3.0, 4.0}));
  EXPECT_EQ(controller.writes("act"), 0u);
  answer({5.0, 6.0, 7.0, 8.0});
  EXPECT_EQ(controller.output<Vector>("act"), Vector({5.0, 6.0, 7.0, 8.0}));
}

TEST_F(ControllerWamTest, AsksNobodyBeforeTheFirstReferenceAndHandsOnWhatItAskedFor) {
  start();
  measure();
  answer({5.0, 6.0, 7.0, 8.0});
  EXPECT_EQ(controller.writes("posRef"), 0u);
  desire(1.0);
  measure();
  answer({5.0, 6.0, 7.0, 8.0});
  answer({1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(controller.writes("act"), 1u);
}

TEST_F(ControllerWamTest, AfterAStopAnAnswerFromBeforeIsNotHandedOn) {
  start();
  desire(1.0);
  measure();
  controller.stop();
  start();
  answer({5.0, 6.0, 7.0, 8.0});
  EXPECT_EQ(controller.writes("act"), 0u);
}

TEST_F(ControllerWamTest, ANumberThatIsNotFiniteIsAFault) {
  start();
  desire(1.0);
  measure();
  answer({5.0, std::nan(""), 7.0, 8.0});
  EXPECT_EQ(controller.state(), component::State::kException);
  EXPECT_EQ(controller.writes("act"), 0u);
}

TEST_F(ControllerWamTest, BreaksNoRuleOfRealTime) {
  start();
  const testing::RealtimeGuard guard;
  for (int i = 0; i < 100; ++i) {
    desire(0.001 * i);
    measure();
    answer({5.0, 6.0, 7.0, 8.0});
  }
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
}

}  // namespace
}  // namespace armature::wam
