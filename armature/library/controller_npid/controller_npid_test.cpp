// SPDX-License-Identifier: Apache-2.0
#include "armature/library/controller_npid/controller_npid.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/testing/harness.hpp"

namespace armature::library {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

class ControllerNpid : public ::testing::Test {
 protected:
  void start(int joints = 2) {
    controller.set("joints", joints);
    ASSERT_TRUE(controller.start()) << controller.reason();
  }
  void desire(double first, double second) {
    controller.write("reference", std::vector<double>{first, second, 0.1, 0.2, 0.3, 0.4});
  }
  void measure(double first, double second) {
    controller.write("sensor", std::vector<double>{first, second, 0.01, 0.02});
  }
  void answer(int pid, double out) { controller.write("Out" + std::to_string(pid), out); }
  double output(const char* port) { return controller.output<double>(port); }
  const std::vector<double>& act() { return controller.output<std::vector<double>>("act"); }
  std::uint64_t acts() { return controller.writes("act"); }

  testing::Harness controller{std::make_unique<ControllerNPID>("Controller")};
};

TEST_F(ControllerNpid, HandsPositionsOutAndWritesActOnceAllHaveAnswered) {
  start();
  desire(1.0, 2.0);
  measure(0.5, 0.6);
  EXPECT_EQ(output("Ref1"), 1.0);
  EXPECT_EQ(output("Ref2"), 2.0);
  EXPECT_EQ(output("Sen1"), 0.5);
  EXPECT_EQ(output("Sen2"), 0.6);
  answer(2, -3.0);
  EXPECT_EQ(acts(), 0u);
  answer(1, 4.0);
  EXPECT_EQ(acts(), 1u);
  EXPECT_THAT(act(), ElementsAre(4.0, -3.0));
}

TEST_F(ControllerNpid, AsksNobodyBeforeTheFirstReference) {
  start();
  measure(0.5, 0.6);
  EXPECT_EQ(controller.writes("Sen1"), 0u);
  measure(0.5, 0.6);
  EXPECT_EQ(controller.get<int>("incomplete_rounds"), 0);
}

TEST_F(ControllerNpid, DoesNotUseAReferenceFromBeforeItsStart) {
  start();
  desire(1.0, 2.0);
  measure(0.5, 0.6);
  controller.stop();
  controller.advance(10ms);
  ASSERT_TRUE(controller.start()) << controller.reason();
  measure(0.5, 0.6);
  EXPECT_EQ(controller.writes("Ref1"), 1u);
  desire(0.5, 0.6);
  measure(0.5, 0.6);
  EXPECT_EQ(output("Ref1"), 0.5);
}

TEST_F(ControllerNpid, HoldsAndNamesAPidThatDidNotAnswer) {
  start();
  desire(1.0, 2.0);
  measure(0.5, 0.6);
  answer(1, 1.0);
  answer(2, 2.0);
  measure(0.5, 0.6);
  answer(1, 1.1);
  measure(0.5, 0.6);
  EXPECT_EQ(controller.get<component::Reason>("missing_names").view(), "Out2");
  EXPECT_THAT(controller.get<std::vector<int>>("missing"), ElementsAre(0, 1));
  answer(2, 2.1);  // late
  EXPECT_EQ(acts(), 1u);
  answer(1, 1.2);
  EXPECT_EQ(acts(), 2u);
  EXPECT_THAT(act(), ElementsAre(1.2, 2.0));
}

TEST_F(ControllerNpid, GivesAPidUpAfterTooManyRounds) {
  start();
  const auto& missing = controller.record<int, ComponentName>("Missing");
  desire(1.0, 2.0);
  for (int round = 0; round < 4; ++round) {
    EXPECT_EQ(controller.state(), component::State::kRunning);
    measure(0.5, 0.6);
    if (round < 3) answer(2, 1.0);
  }
  EXPECT_EQ(controller.state(), component::State::kException);
  EXPECT_EQ(controller.reason(), "Out1 (number 1) did not answer in 3 rounds in a row");
  EXPECT_THAT(missing, ElementsAre(std::make_tuple(1, ComponentName("Out1"))));
  EXPECT_EQ(acts(), 0u);
}

TEST_F(ControllerNpid, GoesOnWithWhatItHasIfNoPidAnswered) {
  start();
  desire(1.0, 2.0);
  measure(0.5, 0.6);
  answer(1, 1.0);
  answer(2, 2.0);
  measure(0.5, 0.6);
  measure(0.5, 0.6);
  EXPECT_EQ(acts(), 2u);
  EXPECT_THAT(act(), ElementsAre(1.0, 2.0));
  EXPECT_EQ(controller.writes("Sen1"), 3u);
}

TEST_F(ControllerNpid, CountsSamplesInWhichNothingWasMeasured) {
  start();
  desire(1.0, 2.0);
  controller.raise("Sample");
  controller.raise("Sample");
  measure(0.5, 0.6);
  controller.raise("Sample");
  EXPECT_EQ(controller.get<int>("samples_without_sensor"), 1);
}

TEST_F(ControllerNpid, StopsIfTheReferenceIsTooOld) {
  start();
  desire(1.0, 2.0);
  controller.advance(60ms);
  measure(0.5, 0.6);
  EXPECT_EQ(controller.state(), component::State::kRunning);
  controller.advance(60ms);
  measure(0.5, 0.6);
  EXPECT_EQ(controller.state(), component::State::kStopped);
  EXPECT_EQ(controller.reason(), "input 'reference': its data is older than declared");
  EXPECT_EQ(controller.writes("Sen1"), 1u);
}

TEST_F(ControllerNpid, StopsIfNothingIsMeasured) {
  start();
  measure(0.5, 0.6);
  for (int i = 0; i < 11; ++i) {
    desire(1.0, 2.0);
    controller.advance(10ms);
  }
  EXPECT_EQ(controller.state(), component::State::kStopped);
  EXPECT_EQ(controller.reason(), "input 'sensor': its data is older than declared");
}

}  // namespace
}  // namespace armature::library
