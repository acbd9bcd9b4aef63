// SPDX-License-Identifier: Apache-2.0
// People operate a simulated robot from the studio. What the robot did is judged by what was
// recorded, in simulated time.
#include <csignal>
#include <cstdint>
#include <span>
#include <tuple>

#include "armature/platform/child_process.hpp"
#include "operated_studio.hpp"

namespace armature::studio {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What a joint may move while nobody has armed it [rad].
constexpr double kStands = 0.01;
constexpr double kPeriod = 0.01;       ///< of the generator [s]
constexpr double kJogPatience = 0.15;  ///< [s]
constexpr double kAcceleration = 5.0;  ///< of the generator's axes [rad/s^2]
constexpr double kEver = 1e9;

TEST_F(OperatedHead, ArmingNeedsTheSeatAndAKeyThatIsHeldForASecondOnceForEachHold) {
  open();
  Browser anna(address());
  Browser bert(address());
  start(anna);
  EXPECT_THAT(anna.arm(), HasSubstr("'Arming.arm' is an act of the operator: nobody sits"));
  EXPECT_THAT(anna.run.call("Arming", "arm", {}, kPatient).error(), HasSubstr("nobody sits"));
  ASSERT_TRUE(bert.workbench.take_seat(kPatient));
  EXPECT_THAT(anna.arm(), HasSubstr("sits at the operator's seat: ask there"));
  EXPECT_THAT(bert.arm(), HasSubstr("the key is not held"));
  bert.hold_key(0.3);
  EXPECT_THAT(bert.arm(), HasSubstr("hold it for 1 s"));
  bert.let_go();
  EXPECT_FALSE(anna.workbench.hold_key(true, kPatient)) << "it is not hers";
  EXPECT_THAT(anna.begin("Generator", "moveTo", {"[1, 1]", "2"}), HasSubstr("arm first"));
  EXPECT_THAT(anna.begin("Generator", "jog", {"1", "0.5"}), HasSubstr("arm first"));
  pass(anna, 0.5);
  bert.hold_key(1.0);
  const double armed_at = bert.time();
  EXPECT_EQ(bert.arm(), "");
  bert.hold_key(1.0);
  EXPECT_THAT(bert.arm(), HasSubstr("let go of it, then hold it again"));
  bert.let_go();
  bert.hold_key(1.0);
  EXPECT_THAT(bert.arm(), ::testing::Not(HasSubstr("key"))) << "another hold is another act";
  const auto moments = recorded();
  EXPECT_LT(moved(moments, 0.0, armed_at), kStands);
  EXPECT_EQ(last_motion(moments), 0.0);
}

TEST_F(OperatedHead, ArmingNeedsTheDeploymentsGrant) {
  open("");
  Browser anna(address());
  start(anna);
  ASSERT_TRUE(anna.workbench.take_seat(kPatient));
  anna.hold_key(1.0);
  EXPECT_THAT(anna.arm(), HasSubstr("grants: {remote: [Arming.arm]}"));
  EXPECT_EQ(anna.run.call("Arming", "isArmed", {}, kPatient).value().value, "false");
  pass(anna, 0.5);
  EXPECT_LT(moved(recorded(), 0.0, kEver), kStands);
}

TEST_F(OperatedHead, AWordOfTheOperatorIsSaidFromTheSeatOnly) {
  open("grants: {remote: [AIC1.position_confirmed]}\n");
  Browser anna(address());
  Browser bert(address());
  const RunSettings saying{true, 1.0, "", {"AIC1.position_confirmed=true"}};
  EXPECT_THAT(anna.workbench.start(saying, kPatient).error(), HasSubstr("nobody sits"));
  start(anna);
  EXPECT_THAT(anna.run.write("AIC1.position_confirmed", "true", kPatient).error(),
              HasSubstr("is an act of the operator"));
  ASSERT_TRUE(bert.workbench.take_seat(kPatient));
  EXPECT_THAT(anna.run.write("AIC1.position_confirmed", "true", kPatient).error(),
              HasSubstr("sits at the operator's seat"));
  EXPECT_EQ(bert.run.write("AIC1.position_confirmed", "true", kPatient).error(), "");
  EXPECT_THAT(bert.run.write("AIC2.position_confirmed", "true", kPatient).error(),
              HasSubstr("grants"));
}

TEST_F(OperatedHead, TheSeatIsHandedOverAndNeverTaken) {
  open();
  Browser anna(address());
  Browser bert(address());
  const int bert_is = bert.workbench.seat(kPatient).value().you;
  const SeatState annas = anna.workbench.take_seat(kPatient).value();
  EXPECT_EQ(annas.holder, annas.you);
  EXPECT_EQ(annas.guests.size(), 2u);
  const auto refused = bert.workbench.take_seat(kPatient);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), HasSubstr("browser " + std::to_string(annas.you) + " ("));
  EXPECT_FALSE(bert.workbench.leave_seat(kPatient)) << "it is not his";
  EXPECT_FALSE(bert.workbench.hand_over(bert_is, kPatient)) << "nor his to give";
  EXPECT_FALSE(anna.workbench.hand_over(999, kPatient)) << "nobody";
  EXPECT_EQ(anna.workbench.hand_over(bert_is, kPatient).value().holder, bert_is);
  EXPECT_FALSE(anna.workbench.take_seat(kPatient)) << "it is given away";
  EXPECT_EQ(bert.workbench.leave_seat(kPatient).value().holder, 0);
  EXPECT_TRUE(anna.workbench.take_seat(kPatient));
}

TEST_F(OperatedHead, WhoIsGoneLosesTheSeatAndTheKeyThatWasHeld) {
  open();
  auto anna = std::make_unique<Browser>(address());
  Browser bert(address());
  start(bert);
  ASSERT_TRUE(anna->workbench.take_seat(kPatient));
  anna->hold_key(1.0);
  EXPECT_FALSE(bert.workbench.take_seat(kPatient));
  anna.reset();
  until([&] { return static_cast<bool>(bert.workbench.take_seat(kPatient)); });
  EXPECT_THAT(bert.arm(), HasSubstr("the key is not held"));
  Browser again(address());
  EXPECT_FALSE(again.workbench.take_seat(kPatient)) << "who comes back sits nowhere";
  pass(bert, 0.5);
  EXPECT_LT(moved(recorded(), 0.0, kEver), kStands);
}

TEST_F(OperatedHead, AJogWhoseBrowserIsLostEndsSmoothlyAfter150Ms) {
  open();
  Browser bert(address());
  auto anna = std::make_unique<Browser>(address());
  start(bert, 0.5);
  arm(*anna);
  const double begun = bert.time();
  ASSERT_EQ(anna->begin("Generator", "jog", {"1", "0.5"}), "");
  while (bert.time() < begun + 1.0) {
    ASSERT_TRUE(anna->keep_jogging("1", "0.5"));
  }
  anna.reset();
  const double lost = bert.time();  // after the last renewal
  pass(bert, 1.0);
  const auto moments = recorded();
  EXPECT_GT(moved(moments, begun, kEver), 0.4) << "it did move";
  EXPECT_LE(last_motion(moments), lost + kJogPatience + 0.5 / kAcceleration + 2 * kPeriod);
  for (std::size_t i = 1; i < moments.size(); ++i) {
    const double change = std::abs(moments[i].velocity[0] - moments[i - 1].velocity[0]);
    if (!std::isnan(change)) EXPECT_LE(change, kAcceleration * kPeriod * 1.01) << "smoothly";
  }
  EXPECT_LT(moved(moments, last_motion(moments) + 0.5, kEver), kStands);
}

TEST_F(OperatedHead, RenewalsThatAreSlowOrComeInABurstMoveNothing) {
  open();
  Browser bert(address());
  Browser anna(address());
  start(bert);
  arm(anna);
  const double begun = anna.time();
  ASSERT_EQ(anna.begin("Generator", "jog", {"1", "0.5"}), "");
  const double accepted = anna.time();
  for (int i = 0; i < 5; ++i) {
    pass(bert, 0.3);
    EXPECT_FALSE(anna.keep_jogging("1", "0.5"));
  }
  std::vector<std::thread> burst;
  std::atomic<int> kept{0};
  for (int i = 0; i < 8; ++i) {
    burst.emplace_back([&] {
      for (int k = 0; k < 20; ++k) kept += anna.keep_jogging("1", "0.5");
    });
  }
  for (auto& one : burst) one.join();
  EXPECT_EQ(kept, 0);
  pass(bert, 0.5);
  const auto moments = recorded();
  EXPECT_LE(last_motion(moments), accepted + kJogPatience + 0.5 / kAcceleration + 2 * kPeriod);
  const double most = 0.5 * (accepted - begun + kJogPatience + 2 * kPeriod + 0.5 / kAcceleration);
  EXPECT_LT(moved(moments, begun, kEver), most);
}

TEST_F(OperatedHead, AMotionWhoseBrowserIsLostIsBrakedAndTheRobotHeld) {
  open();
  Browser anna(address());
  auto bert = std::make_unique<Browser>(address());
  start(anna);
  arm(anna);
  ASSERT_EQ(bert->begin("Generator", "moveTo", {"[4, 4]", "20"}), "");
  pass(anna, 2.0);
  bert.reset();
  const double lost = anna.time();
  pass(anna, 4.0);
  EXPECT_EQ(anna.run.call("Arming", "isArmed", {}, kPatient).value().value, "true");
  const auto moments = recorded();
  EXPECT_GT(last_motion(moments), lost - 0.5);
  EXPECT_LT(last_motion(moments), lost + 3.0) << "of 20 s";
}

TEST_F(OperatedHead, AnEmergencyStopOfWhoHasNoSeatEndsAMotion) {
  open();
  Browser anna(address());
  Browser bert(address());
  start(anna);
  arm(anna);
  const double begun = anna.time();
  ASSERT_EQ(anna.begin("Generator", "moveTo", {"[3, 3]", "4"}), "");
  pass(anna, 1.5);
  const auto stopped = bert.workbench.emergency_stop(kPatient);
  ASSERT_TRUE(stopped) << stopped.error();
  EXPECT_THAT(stopped.value().disarmed, ElementsAre("Arming"));
  EXPECT_EQ(stopped.value().stopped, "") << "the run goes on";
  const double at = anna.time();
  EXPECT_THAT(anna.begin("Generator", "moveTo", {"[0, 0]", "4"}), HasSubstr("arm first"));
  EXPECT_THAT(anna.arm(), HasSubstr("the key is not held"));
  pass(anna, 2.0);
  const auto moments = recorded();
  EXPECT_GT(moved(moments, begun, at), 0.3) << "it was in motion";
  EXPECT_LE(last_motion(moments), at + kPeriod);
  EXPECT_LT(moved(moments, at + 0.5, kEver), kStands);
}

TEST_F(OperatedHead, AnEmergencyStopWaitsForNothingThatTheStudioIsAbout) {
  open();
  Browser anna(address());
  start(anna);
  arm(anna);
  busy();
  const auto stopped = anna.workbench.emergency_stop(kPatient);
  ASSERT_TRUE(stopped) << stopped.error();
  EXPECT_THAT(stopped.value().disarmed, ElementsAre("Arming"));
}

TEST_F(OperatedHead, ARunThatDoesNotConfirmIsStopped) {
  open();
  Browser anna(address());
  start(anna);
  const int process = server_->running();
  platform::send_signal(process, SIGSTOP);
  std::thread later([&] {
    std::this_thread::sleep_for(3s);
    platform::send_signal(process, SIGCONT);
  });
  const auto stopped = anna.workbench.emergency_stop(kPatient);
  later.join();
  ASSERT_TRUE(stopped) << stopped.error();
  EXPECT_THAT(stopped.value().disarmed, IsEmpty());
  EXPECT_THAT(stopped.value().stopped, HasSubstr("does not confirm"));
  until([&] { return state(anna) == "ended"; });
}

TEST_F(OperatedHead, WhoMayOnlyLookSitsNowhereAndStopsNothing) {
  policy_ = (folder_ / "studio.policy").string();
  std::ofstream(policy_) << "allow local:* read workbench,run\n";
  open();
  Browser anna(address());
  EXPECT_FALSE(anna.workbench.seat(kPatient).value().guests.at(0).may_operate);
  for (const auto& refused :
       {anna.workbench.take_seat(kPatient).error(), anna.workbench.hold_key(true, kPatient).error(),
        anna.workbench.emergency_stop(kPatient).error()}) {
    EXPECT_THAT(refused, HasSubstr("may not command 'workbench'"));
  }
  close();
}

TEST_F(OperatedHead, WhatIsNoRequestOfTheInspectorPassesNothing) {
  open();
  Browser anna(address());
  start(anna);
  ASSERT_TRUE(anna.workbench.take_seat(kPatient));
  RawPlaceholder raw(anna.peer(), "run", remote::kInspector);
  const auto ask = [&raw](ride::Number number, const auto&... parameters) {
    std::atomic<int> code{-1};
    const auto all = std::tie(parameters...);
    raw.ask(number, {}, ride::Fields(all),
            [&](ride::Code told, std::string_view, std::span<const std::byte>) {
              code = static_cast<int>(told);
            });
    while (code < 0) std::this_thread::sleep_for(1ms);
    return static_cast<ride::Code>(code.load());
  };
  const ride::Number begin = number_named(remote::kInspector, "begin");
  const std::string arming = "Arming";
  const std::string arm = "arm";
  const std::string no_text = "\xff\xfe";
  const std::vector<std::string> none;
  const std::uint32_t long_size = 0xffffffffu;
  EXPECT_EQ(ask(begin), ride::Code::kMalformed);
  EXPECT_EQ(ask(begin, arming), ride::Code::kMalformed);
  EXPECT_EQ(ask(begin, long_size, arm), ride::Code::kMalformed);
  EXPECT_EQ(ask(begin, arming, no_text, none), ride::Code::kMalformed);
  EXPECT_EQ(ask(begin, arming, arm, none), ride::Code::kFailed) << "the key is not held";
  for (const char* name : {"Arming ", "arming", "", "Arming.", "Nobody"}) {
    EXPECT_THAT(anna.begin(name, "arm"), HasSubstr("has not described it"));
  }
  EXPECT_THAT(anna.begin("Arming", "arm "), HasSubstr("has not described it"));
  EXPECT_EQ(anna.run.call("Arming", "isArmed", {}, kPatient).value().value, "false");
}

TEST_F(OperatedHead, WhoFloodsTheStudioKeepsNobodyFromStopping) {
  open();
  Browser anna(address());
  start(anna);
  arm(anna);
  ASSERT_EQ(anna.begin("Generator", "moveTo", {"[3, 3]", "4"}), "");
  std::atomic<bool> goes_on{true};
  std::atomic<int> answered{0};
  std::thread flood([&] {
    Browser mallory(address());
    RawPlaceholder workbench(mallory.peer(), "workbench", kWorkbench);
    RawPlaceholder run(mallory.peer(), "run", remote::kInspector);
    const auto told = [&](ride::Code, std::string_view, std::span<const std::byte>) { ++answered; };
    const std::string generator = "Generator";
    const std::tuple<> nothing;
    const ride::Number models = number_named(kWorkbench, "models");
    const ride::Number project = number_named(kWorkbench, "project");
    const ride::Number describe = number_named(remote::kInspector, "describe");
    while (goes_on) {
      workbench.ask(models, {}, ride::Fields(nothing), told);
      workbench.ask(project, {}, ride::Fields(nothing), told);
      run.ask(describe, {}, ride::Fields(std::tie(generator)), told);
    }
  });
  until([&] { return answered > 5000; });
  const auto stopped = anna.workbench.emergency_stop(kPatient);
  EXPECT_TRUE(stopped) << stopped.error();
  if (stopped) {
    EXPECT_THAT(stopped.value().disarmed, ElementsAre("Arming")) << stopped.value().stopped;
  }
  const double at = anna.time();
  const int process = server_->running();
  [[maybe_unused]] const auto ends = anna.workbench.stop(kPatient);
  until([&] { return !platform::process_has_argument(process, "run"); });
  goes_on = false;
  flood.join();
  const auto moments = recorded();
  if (!std::isnan(at)) EXPECT_LE(last_motion(moments), at + kPeriod);
  EXPECT_GT(last_motion(moments), 0.0);
}

TEST_F(OperatedHead, TheRunIsAskedForABoundedNumberOfThingsAtOnce) {
  constexpr int kAsked = 100;
  constexpr int kPassedOn = 16;
  open();
  Browser anna(address());
  Browser mallory(address());
  start(anna);
  const int process = server_->running();
  platform::send_signal(process, SIGSTOP);
  std::atomic<int> refused{0};
  std::atomic<int> given{0};
  RawPlaceholder run(mallory.peer(), "run", remote::kInspector);
  const std::string generator = "Generator";
  for (int i = 0; i < kAsked; ++i) {
    run.ask(number_named(remote::kInspector, "describe"), {}, ride::Fields(std::tie(generator)),
            [&](ride::Code code, std::string_view why, std::span<const std::byte>) {
              if (code == ride::Code::kNone) ++given;
              if (why.find("too many requests") != std::string_view::npos) ++refused;
            });
  }
  until([&] { return refused == kAsked - kPassedOn; });
  EXPECT_EQ(given, 0);
  platform::send_signal(process, SIGCONT);
  EXPECT_FALSE(std::isnan(anna.time())) << "others are answered";
  until([&] { return given == kPassedOn; });
}

}  // namespace
}  // namespace armature::studio
