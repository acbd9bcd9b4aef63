// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/controller_npid/controller_npid.hpp"

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/face.hpp"
#include "armature/component/interface.hpp"
#include "armature/testing/harness.hpp"

namespace armature::controllers {
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
    controller.raise("Sample");
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

TEST_F(ControllerNpid, RefusesASwitchTimeOfMoreThanHalfASecond) {
  EXPECT_NO_THROW(controller.set("SwitchTime", 0.5));
  EXPECT_THROW(controller.set("SwitchTime", 0.6), std::invalid_argument);
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

TEST_F(ControllerNpid, StopsIfNoReferenceComesAtAll) {
  start();
  measure(0.5, 0.6);
  for (int i = 0; i < 11; ++i) {
    EXPECT_EQ(controller.state(), component::State::kRunning);
    controller.advance(10ms);
    measure(0.5, 0.6);
  }
  EXPECT_EQ(controller.state(), component::State::kStopped);
  EXPECT_EQ(controller.reason(), "input 'reference': its data is older than declared");
}

/// With MaxAcceleration an old reference is no end.
class ControllerThatBrakes : public ControllerNpid {
 protected:
  ControllerThatBrakes() {
    controller.set("MaxAcceleration", std::vector<double>{2.0});
    controller.set("Period", 0.01);
  }
  /// As fast as they are to be.
  void measure(double first, double second) {
    controller.raise("Sample");
    controller.write("sensor", std::vector<double>{first, second, 0.001, 0.002});
  }
  /// A sampling period in which the joints are where they are to be.
  void follow() {
    controller.advance(10ms);
    measure(output("Ref1"), output("Ref2"));
    answer(1, 0.0);
    answer(2, 0.0);
  }
  void desire_rest(double first, double second) {
    controller.write("reference", std::vector<double>{first, second, 0.0, 0.0, 0.0, 0.0});
  }
  void lose_reference() {
    start();
    desire(1.0, 2.0);  // at 0.1 and 0.2 rad/s
    measure(1.0, 2.0);
    for (int i = 0; i < 10; ++i) follow();
    ASSERT_EQ(controller.get<int>("brakings"), 0);
    for (int i = 0; i < 20; ++i) follow();
  }
};

TEST_F(ControllerThatBrakes, BringsTheJointsToRestAndHoldsThemIfTheReferenceIsTooOld) {
  lose_reference();
  EXPECT_EQ(controller.state(), component::State::kRunning);
  EXPECT_EQ(controller.get<int>("brakings"), 1);
  EXPECT_NEAR(output("Ref1"), 1.0 + 0.1 * 0.1 / 4.0, 1e-9);
  EXPECT_NEAR(output("Ref2"), 2.0 + 0.2 * 0.2 / 4.0, 1e-9);
}

TEST_F(ControllerThatBrakes, AfterAnAbsurdReferenceFromWhatIsMeasured) {
  start();
  measure(1.0, 2.0);
  controller.write("reference", std::vector<double>{1e9, -1e9, 1e9, 1e9, 0.0, 0.0});
  for (int i = 0; i < 30; ++i) {
    controller.advance(10ms);
    measure(1.0, 2.0);
    answer(1, 0.0);
    answer(2, 0.0);
  }
  EXPECT_EQ(controller.get<int>("brakings"), 1);
  EXPECT_NEAR(output("Ref1"), 1.0 + 0.1 * 0.1 / 4.0, 1e-9);
  EXPECT_NEAR(output("Ref2"), 2.0 + 0.2 * 0.2 / 4.0, 1e-9);
}

TEST_F(ControllerThatBrakes, BeginsInTheFirstPeriodWithoutAReferenceAndFollowsOneThatIsOnlyLate) {
  start();
  desire(1.0, 2.0);
  measure(1.0, 2.0);
  follow();
  EXPECT_NEAR(output("Ref1"), 1.0 + 0.01 * (0.1 + 0.08) / 2.0, 1e-12);
  EXPECT_NEAR(output("Ref2"), 2.0 + 0.01 * (0.2 + 0.18) / 2.0, 1e-12);
  desire(1.002, 2.004);
  follow();
  EXPECT_EQ(output("Ref1"), 1.002);
  EXPECT_EQ(controller.get<int>("brakings"), 0);
}

TEST_F(ControllerThatBrakes, DoesNotGoOnWithAMotionThatWentOnWithoutIt) {
  lose_reference();
  const double held = output("Ref1");
  desire(1.0, 2.0);
  follow();
  desire_rest(1.5, 2.0);
  follow();
  EXPECT_EQ(output("Ref1"), held);
  EXPECT_EQ(controller.get<int>("brakings"), 1);
}

TEST_F(ControllerThatBrakes, GoesOnWithAReferenceThatBeginsWhereTheJointsAre) {
  lose_reference();
  const double first = output("Ref1");
  const double second = output("Ref2");
  desire_rest(first - 0.001, second);
  follow();
  EXPECT_EQ(output("Ref1"), first - 0.001);
  desire(first + 0.1, second);
  follow();
  EXPECT_EQ(output("Ref1"), first + 0.1);
}

TEST_F(ControllerThatBrakes, IsNotConfiguredWithNumbersThatCannotBe) {
  controller.set("MaxAcceleration", std::vector<double>{2.0, -1.0});
  EXPECT_FALSE(controller.start());
  EXPECT_THAT(std::string(controller.reason()), ::testing::HasSubstr("max_acceleration is -1"));
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

/// Another controller wrote `act` so far; 10 ms later this one starts in its place.
class ControllerNpidInPlaceOfAnother : public ControllerNpid {
 protected:
  void take_over(double first, double second) {
    controller.set("SwitchTime", 0.5);
    controller.set("joints", 2);
    desire(1.0, 2.0);
    other.port.set_sample({first, second});
    controller.advance(10ms);
    port("act").take_over_from(&face(other.port));
    ASSERT_TRUE(controller.start()) << controller.reason();
    port("act").take_over_from(nullptr);
  }
  component::OutputPortBase& port(std::string_view name) {
    for (auto* output : component::interface_of(controller.component()).outputs) {
      if (output->name() == name) return *output;
    }
    throw std::invalid_argument("there is no such port");
  }
  void round(double first, double second) {
    measure(0.5, 0.6);
    answer(1, first);
    answer(2, second);
  }

  struct Other : component::Component {
    using Component::Component;
    component::OutputPort<std::vector<double>> port{this, "act", "", "V"};
  } other{"Other"};
};

TEST_F(ControllerNpidInPlaceOfAnother, GoesOnFromItsOutputAndTheDifferenceDiesAway) {
  take_over(4.0, -3.0);
  round(0.1, 0.2);
  EXPECT_THAT(act(), ElementsAre(4.0, -3.0));
  const auto after = [this](base::Duration time) {
    controller.advance(time);
    desire(1.0, 2.0);
    round(0.1, 0.2);
    return act()[0];
  };
  EXPECT_NEAR(after(10ms), 3.995, 0.002);
  for (int k = 0; k < 5; ++k) after(40ms);
  EXPECT_NEAR(after(40ms), 0.1 + 0.5 * 3.9, 1e-9) << "half of it after half the time";
  for (int k = 0; k < 6; ++k) after(40ms);
  EXPECT_GT(act()[0], 0.1);
  after(10ms);
  EXPECT_THAT(act(), ElementsAre(0.1, 0.2));
}

TEST_F(ControllerNpidInPlaceOfAnother, UsesTheReferenceThatIsThereSoThatNoCycleIsLost) {
  take_over(4.0, -3.0);
  measure(0.5, 0.6);
  EXPECT_EQ(controller.writes("Ref1"), 1u);
}

TEST_F(ControllerNpidInPlaceOfAnother, BrakesIfTheReferenceWasNotFollowedAnyMore) {
  controller.set("MaxAcceleration", "[5.0]");
  controller.set("Period", 0.01);
  take_over(4.0, -3.0);
  measure(0.5, 0.6);  // 0.5 rad and more from the reference
  EXPECT_NEAR(output("Ref1"), 0.5, 0.02);
  EXPECT_NEAR(output("Ref2"), 0.6, 0.03);
  EXPECT_EQ(controller.get<int>("brakings"), 1);
}

TEST_F(ControllerNpidInPlaceOfAnother, FollowsWhatWasFollowed) {
  controller.set("MaxAcceleration", "[5.0]");
  controller.set("Period", 0.01);
  take_over(4.0, -3.0);
  measure(0.98, 1.97);
  EXPECT_EQ(output("Ref1"), 1.0);
  EXPECT_EQ(controller.get<int>("brakings"), 0);
}

TEST_F(ControllerNpidInPlaceOfAnother, ArmingEndsIt) {
  take_over(4.0, -3.0);
  round(0.1, 0.2);
  controller.raise("Arm");
  controller.advance(10ms);
  round(0.1, 0.2);
  EXPECT_THAT(act(), ElementsAre(0.1, 0.2));
}

TEST_F(ControllerNpidInPlaceOfAnother, APlainStartForgetsIt) {
  take_over(4.0, -3.0);
  controller.stop();
  ASSERT_TRUE(controller.start()) << controller.reason();
  desire(1.0, 2.0);
  round(0.1, 0.2);
  EXPECT_THAT(act(), ElementsAre(0.1, 0.2));
}

}  // namespace
}  // namespace armature::controllers
