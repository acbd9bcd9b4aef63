// SPDX-License-Identifier: Apache-2.0
// The way home, and that an arm which is held away from there is not let go of.
#include <chrono>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/wam/in_motion.hpp"

namespace armature::wam {
namespace {

using ::testing::HasSubstr;

/// Armed, and at rest away from home.
class ArmAway : public Arm {
 public:
  ArmAway() : Arm("npid7.yaml") {
    start_armed();
    run_for(1500ms);
    EXPECT_EQ(move_to(kTarget, 5.0), "");
    run_for(7s);
  }
  void disarm() {
    EXPECT_EQ(call("Arming", "disarm"), "");
    run_for(2s);
  }
};

/// Armed, and for two seconds on its way.
component::CommandHandle begin_to_move(Arm& arm) {
  arm.start_armed();
  arm.run_for(1500ms);
  auto motion = arm.application().begin("Generator", "moveTo",
                                        {types::Value::of(kTarget), types::Value::of(5.0)});
  EXPECT_TRUE(motion) << motion.error();
  arm.run_for(2s);
  return std::move(motion).value();
}

TEST(WamHome, BeforeTheStopAMotionComesToRestAndTheArmGoesHome) {
  Arm arm("npid7.yaml");
  const component::CommandHandle motion = begin_to_move(arm);
  EXPECT_GT(largest_apart(arm.positions(), wam7().home), 0.1);
  EXPECT_EQ(arm.application().run_before_stop(exec::RunEnd::kTimeUp).to_text(), "");
  EXPECT_EQ(motion.stage(), component::CommandStage::kCancelled);
  EXPECT_TRUE(arm.armed());
  EXPECT_LT(largest_apart(arm.positions(), wam7().home), 0.005);
}

TEST(WamHome, AfterAMistakeItComesToRestAndDoesNotGoHome) {
  Arm arm("npid7.yaml", {}, [](exec::ApplicationOptions& options) { options.hold_at_stop = 3s; });
  const component::CommandHandle motion = begin_to_move(arm);
  exec::Application& application = arm.application();
  EXPECT_EQ(
      application.run_before_stop(exec::RunEnd::kStopRequested, nullptr, exec::Leave::kAfterMistake)
          .to_text(),
      "");
  EXPECT_EQ(motion.stage(), component::CommandStage::kCancelled);
  arm.run_for(1s);
  const Vector rest = arm.positions();
  EXPECT_GT(largest_apart(rest, wam7().home), 0.1);
  EXPECT_THAT(application.hold_until_told().to_text(),
              HasSubstr("'WAM' lets go, since no answer came: it held the arm's weight away from "
                        "home"));
  EXPECT_LT(largest_apart(arm.positions(), rest), 0.002) << "held for 3 s";
  EXPECT_TRUE(arm.armed());
}

TEST(WamHome, HeldUnarmedAwayFromHomeItIsHeldUntilTheOperatorAnswers) {
  ArmAway arm;
  arm.disarm();
  const Vector rest = arm.positions();
  exec::Application& application = arm.application();
  EXPECT_THAT(application.run_before_stop(exec::RunEnd::kTimeUp).to_text(),
              HasSubstr("'WAM.moveHome' was refused: the arm is not armed"));
  const base::Time begin = application.now();
  const auto answer_late = [&](base::Duration) {
    arm.run_for(20s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.002);
    arm.set("WAM", "held_by_hand", true);
    return false;
  };
  EXPECT_EQ(application.hold_until_told(nullptr, answer_late).to_text(), "");
  EXPECT_LT(application.now() - begin, 25s);
  EXPECT_THAT(
      arm.log,
      HasSubstr("arm it, then call WAM:moveHome(); or hold it, and set WAM.held_by_hand = true"));
}

TEST(WamHome, AtHomeOrIdleNobodyIsAsked) {
  Arm arm("npid7.yaml");
  arm.start_active();
  EXPECT_EQ(arm.application().run_before_stop(exec::RunEnd::kTimeUp).to_text(), "");
  EXPECT_TRUE(arm.application().held().empty());
}

TEST(WamHome, StoppingTheHardwareGoesHomeFirst) {
  ArmAway arm;
  ASSERT_TRUE(arm.application().stop_component("WAM"));
  EXPECT_EQ(arm.state("WAM"), State::kRunning);
  for (int i = 0; i < 10000 && arm.state("WAM") == State::kRunning; ++i) arm.cycle();
  EXPECT_EQ(arm.state("WAM"), State::kStopped) << arm.log;
  EXPECT_LT(largest_apart(arm.positions(), wam7().home), 0.05);
}

TEST(WamHome, TheHardwareIsNotStoppedWhileItHoldsTheArmUnarmedAwayFromHome) {
  ArmAway arm;
  arm.disarm();
  const auto refused = arm.application().stop_component("WAM");
  EXPECT_FALSE(refused);
  EXPECT_THAT(std::string(refused.reason()),
              HasSubstr("'WAM.moveHome' was refused: the arm is not armed"));
  arm.set("WAM", "held_by_hand", true);
  EXPECT_TRUE(arm.application().stop_component("WAM"));
  EXPECT_EQ(arm.state("WAM"), State::kStopped);
  EXPECT_FALSE(arm.value<bool>("WAM", "held_by_hand")) << "it counted once";
}

TEST(WamHome, WhoSamplesTheArmIsNotStoppedWhileItIsHeldAwayFromHome) {
  ArmAway arm;
  for (const bool armed : {true, false}) {
    if (!armed) arm.disarm();
    const auto refused = arm.application().stop_component("Sampler");
    EXPECT_FALSE(refused);
    EXPECT_THAT(std::string(refused.reason()),
                HasSubstr("'Sampler' was not stopped, since 'WAM' needs it and holds the arm's "
                          "weight away from home"));
    const Vector rest = arm.positions();
    arm.run_for(1s);
    EXPECT_LT(largest_apart(arm.positions(), rest), 0.005);
  }
  arm.set("WAM", "held_by_hand", true);
  EXPECT_TRUE(arm.application().stop_component("Sampler"));
}

TEST(WamHome, IsRefusedUnarmed) {
  Arm arm("npid4.yaml");
  arm.start_active();
  EXPECT_THAT(arm.call("WAM", "moveHome"), HasSubstr("the arm is not armed"));
}

TEST(WamTwice, TwoRunsAreTheSameToTheBit) {
  const auto run = [] {
    Arm arm("npid7.yaml");
    arm.start_armed();
    EXPECT_EQ(arm.move_to(kTarget, 5.0), "");
    arm.run_for(3s);
    return arm.positions();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace armature::wam
