// SPDX-License-Identifier: Apache-2.0
// What is wrong with an arm is named; what goes wrong on the way is mended or named.
#include <chrono>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/wam/driver/test_hosted_bench.hpp"
#include "robots/wam/driver/wam_startup.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

// ---- What is wrong is named

TEST(WamStartupFaults, ASilentBoardIsNamed) {
  Hosted bench;
  bench.power_up();
  bench.board().set_dead(true);
  EXPECT_EQ(bench.connect(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("the safety board, node 10, does not answer; found nodes 1, "
                                      "2, 3, 4, 5, 6, 7 (check its power"));
}

TEST(WamStartupFaults, AnEmptyBusIsNamed) {
  Hosted bench;
  bench.board().set_dead(true);
  EXPECT_EQ(bench.connect(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("does not answer; found no node"));
}

TEST(WamStartupFaults, APuckThatDoesNotWakeUpIsNamed) {
  auto config = Emulator::standard(7);
  config.pucks[3].wake_time = 60s;
  Hosted bench(config);
  bench.power_up();
  EXPECT_EQ(bench.connect(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("puck 4 did not wake up: status unknown, it does not answer, "
                                      "expected 2"));
}

TEST(WamStartupFaults, APuckThatIsSetUpOtherwiseIsNamed) {
  auto config = Emulator::standard(7);
  config.pucks[4].groups = {0, 5, 5};  // the convention of older arms
  Hosted groups(config);
  groups.power_up();
  EXPECT_EQ(groups.connect(), WamProgress::kFailed);
  EXPECT_THAT(groups.said(),
              HasSubstr("puck 5 is in groups 0, 5 and 5, expected 0, 2 for torques and 4 for "
                        "positions (set GRPA, GRPB and GRPC to these and save them)"));

  config = Emulator::standard(7);
  config.pucks[1].slot = 3;
  Hosted slot(config);
  slot.power_up();
  EXPECT_EQ(slot.connect(), WamProgress::kFailed);
  EXPECT_THAT(slot.said(), HasSubstr("puck 2 takes torque 3 of its frame (PIDX), expected 2"));

  config = Emulator::standard(7);
  config.pucks[0].most_torque = 0;
  Hosted torque(config);
  torque.power_up();
  EXPECT_EQ(torque.connect(), WamProgress::kFailed);
  EXPECT_THAT(torque.said(), HasSubstr("puck 1 has MT 0, expected above 0"));
}

TEST(WamStartupFaults, APuckInErrorIsNamed) {
  EXPECT_THAT(check_motor(3, kAbsoluteEncoder, 1).value().message,
              HasSubstr("puck 3 has status 1, expected 0 (reset) or 2 (ready)"));
  EXPECT_FALSE(check_motor(3, kAbsoluteEncoder, 2));
}

TEST(WamStartupFaults, ANodeThatIsNoMotorIsNamed) {
  auto config = Emulator::standard(7);
  config.pucks[5].role = 6;
  Hosted bench(config);
  bench.power_up();
  EXPECT_EQ(bench.connect(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("puck 6 has role 6, expected 0, a motor puck"));
}

// ---- Disturbances

TEST(WamStartupFaults, ALostAnswerIsAskedForAgain) {
  Hosted bench;
  bench.wake_up();
  bench.puck(2).lose_replies(1);
  bench.board().lose_replies(1);
  EXPECT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.startup->counters().repeated, 2u);
}

TEST(WamStartupFaults, ALateAnswerIsNotTakenForAnother) {
  Hosted bench;
  bench.wake_up();
  bench.puck(3).delay_replies(3ms);
  EXPECT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.startup->record().pucks[2].counts_per_turn, 4096);

  bench.puck(3).delay_replies(7ms);  // later than the window of the first question
  EXPECT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.startup->record().pucks[2],
            (PuckRecord{3, 175, kAbsoluteEncoder, 4096, 2700, 4860, 3, {0, 1, 4}}));
  EXPECT_GE(bench.startup->counters().unexpected, 1u);
}

TEST(WamStartupFaults, SpoiledAnswersAreAskedForAgain) {
  for (const ReplySpoil spoil :
       {ReplySpoil::kWrongProperty, ReplySpoil::kWrongLength, ReplySpoil::kSecondByte}) {
    Hosted bench;
    bench.wake_up();
    bench.puck(1).spoil_replies(spoil);
    EXPECT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
    EXPECT_EQ(bench.startup->counters().repeated, 1u);
    EXPECT_EQ(bench.startup->counters().unexpected, 1u);
  }
}

TEST(WamStartupFaults, AnswersMayHaveSixBytes) {
  auto config = Emulator::standard(7);
  for (auto& puck : config.pucks) puck.replies = ReplyWidth::kAlwaysSix;
  config.board.replies = ReplyWidth::kAlwaysSix;
  Hosted bench(config);
  bench.power_up();
  EXPECT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
}

TEST(WamStartupFaults, AHostThatWasDrivenBusOffComesBack) {
  Hosted bench;
  bench.power_up();
  bench.startup->connect(bench.now());
  bench.talk_for(20ms);
  bench.host.force_bus_off();
  EXPECT_EQ(bench.talk(), WamProgress::kDone) << bench.said();
}

TEST(WamStartupFaults, EstopInTheMiddleIsNamedByWhoIsGone) {
  Hosted bench;
  bench.power_up();
  bench.startup->connect(bench.now());
  bench.talk_for(500ms);
  bench.board().estop();
  EXPECT_EQ(bench.talk(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("puck 1 did not wake up"));
  EXPECT_EQ(bench.connect(), WamProgress::kWaitingForIdle) << "it can begin again";
}

TEST(WamStartupFaults, AHomeThatPucksCannotCountToIsRefused) {
  Hosted bench;
  bench.power_up();
  WamStartup::Config config;
  config.home[1] = 4000.0;
  bench.startup = WamStartup::make(bench.host, config).value();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  EXPECT_EQ(bench.zero(), WamProgress::kFailed);
  EXPECT_THAT(bench.said(), HasSubstr("home of motor 2 is 4000.000000 rad, expected what fits"));
  EXPECT_FALSE(bench.board().zeroed());
}

TEST(WamStartupFaults, RefusesWhatIsNoArm) {
  Bench bench;
  WamStartup::Config config;
  config.motors = 6;
  EXPECT_EQ(WamStartup::make(bench.host, config).error(),
            "WAM on bus 'can0.host': 6 motors, expected 4 or 7");
  config.motors = 7;
  config.home[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(WamStartup::make(bench.host, config).error(),
              HasSubstr("home of motor 3 is not a finite number"));
  config.home[2] = 0.0;
  config.answer_window = {};
  EXPECT_THAT(WamStartup::make(bench.host, config).error(), HasSubstr("answer_window"));
}

}  // namespace
}  // namespace armature::wam
