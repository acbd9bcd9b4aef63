// SPDX-License-Identifier: Apache-2.0
// What a deployment has done before an orderly stop.
#include <atomic>
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/face.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using ::testing::HasSubstr;
using types::Value;

/// Says in each cycle that it is time.
class Clock : public component::Component {
 public:
  using Component::Component;

 private:
  void on_update() override { tick_.raise(); }

  component::Event<> tick_{this, "Tick", ""};
};

/// Says so to others.
class Relay : public component::Component {
 public:
  using Component::Component;

 private:
  void on_tick() { beat_.raise(); }

  component::EventHandler<> tick_{this, "Tick", component::serve<&Relay::on_tick>, ""};
  component::Event<> beat_{this, "Beat", ""};
};

/// The threads of loads do not go on.
std::atomic<bool> hangs{false};
/// One of them has come to that.
std::atomic<bool> hanging{false};

/// Lies in nobody's hand but the motor's.
class Load : public component::Component {
 public:
  using Component::Component;

 private:
  component::Reason held() {
    return held_() && !word_.said() ? component::Reason("a load; say `put_down`, or hold it")
                                    : component::Reason();
  }
  component::Outcome put_down() {
    if (stuck_) return component::refused("it is stuck");
    putting_down_ = 5;
    return component::accepted();
  }
  void on_update() override {
    if (hangs) hang();
    if (putting_down_ > 0 && --putting_down_ == 0) held_.assign(false);
  }
  static void hang() {
    const rt::PermitScope what_a_test_does_is_no_real_time_code;
    hanging = true;
    hangs.wait(true);
  }
  bool lies() { return !held_(); }

  component::Property<bool> held_{this, "held", true, "", "", component::changeable_while_running};
  component::Property<bool> stuck_{this, "stuck", false,
                                   "",   "",      component::changeable_while_running};
  component::OperatorsWord word_{this, "in_my_hands", "the operator holds the load"};
  component::Command<> put_down_{this, "put_down", component::serve<&Load::put_down>, "",
                                 component::done_when<&Load::lies>};
  void count() { ++beats_; }

  component::EventHandler<> beat_{this, "Beat", component::serve<&Load::count>, "",
                                  component::optional};
  component::Holding holding_{this, component::serve<&Load::held>, beat_};
  int beats_ = 0;
  int putting_down_ = 0;
};

/// Goes home one step in each cycle, unless something holds it.
class Arm : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome begin_home() {
    if (steps_ > 1000) return component::refused("home is too far away");
    if (steps_ < 0) fault("it is behind its home");
    going_ = true;
    return component::accepted();
  }
  void on_update() override {
    if (going_ && !holds_ && steps_gone_ < steps_) steps_gone_.assign(steps_gone_ + 1);
  }
  bool at_home() { return steps_gone_ == steps_; }

  component::Property<int> steps_{
      this, "steps", 5, "how far it is from home", "", component::changeable_while_running};
  component::Property<bool> holds_{
      this, "holds", false, "it does not move", "", component::changeable_while_running};
  component::Command<> home_{this, "home", component::serve<&Arm::begin_home>, "goes home",
                             component::done_when<&Arm::at_home>};
  component::Attribute<int> steps_gone_{this, "steps_gone", 0, "towards home"};
  bool going_ = false;
};

class BeforeStop : public ::testing::TestWithParam<bool> {
 protected:
  BeforeStop() {
    Blueprint blueprint;
    blueprint.add<Arm>("Left", Activity::periodic(1ms));
    blueprint.add<Arm>("Right", Activity::periodic(1ms));
    blueprint.add<Arm>("Shadow", Activity::periodic(1ms));
    blueprint.components.back().shadow = true;
    ApplicationOptions options = patient(GetParam());
    options.before_stop = {{"Left", "home"}, {"Right", "home"}};
    options.before_stop_limit = 1s;
    options.log = [this](const rt::LogRecord& record) { log_ += record.message() + "\n"; };
    application_.emplace(std::move(blueprint), std::move(options));
    EXPECT_EQ(application_->start().to_text(), "");
  }
  std::string finish(RunEnd end = RunEnd::kTimeUp) {
    return application_->run_before_stop(end).to_text();
  }
  void set(const char* arm, const char* property, Value value) {
    const auto done = application_->set_property(arm, property, value);
    EXPECT_TRUE(done) << done.error();
  }
  int steps_gone(const char* arm) {
    return *application_->value_of(arm, "steps_gone").value().get_if<int>();
  }

  std::string log_;
  std::optional<Application> application_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, BeforeStop, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(BeforeStop, ItsCommandsAreDoneOneAfterTheOther) {
  EXPECT_EQ(finish(), "");
  EXPECT_EQ(steps_gone("Left"), 5);
  EXPECT_EQ(steps_gone("Right"), 5);
}

TEST_P(BeforeStop, APauseOfSimulatedTimeEndsWithTheRun) {
  const bool paused = application_->set_pace({.paused = true}).ok();
  EXPECT_EQ(paused, GetParam()) << "real time cannot be paused";
  EXPECT_EQ(finish(), "");
  EXPECT_EQ(steps_gone("Right"), 5);
}

TEST_P(BeforeStop, WhatIsUnderWayIsCancelledFirst) {
  set("Left", "holds", Value::of(true));
  auto before = application_->begin("Left", "home", {});
  ASSERT_TRUE(before) << before.error();
  application_->run_for(10ms);
  ASSERT_EQ(before.value().stage(), component::CommandStage::kAccepted);
  EXPECT_THAT(finish(), HasSubstr("'Left.home' did not end within 1 s")) << "it was begun";
  EXPECT_EQ(before.value().stage(), component::CommandStage::kCancelled);
}

TEST_P(BeforeStop, NothingBeginsAfterAMistakeButWhatIsUnderWayIsCancelled) {
  set("Left", "holds", Value::of(true));
  const auto before = application_->begin("Left", "home", {});
  ASSERT_TRUE(before) << before.error();
  EXPECT_EQ(application_->run_before_stop(RunEnd::kStopRequested, nullptr, Leave::kAfterMistake)
                .to_text(),
            "");
  EXPECT_EQ(before.value().stage(), component::CommandStage::kCancelled);
  EXPECT_EQ(steps_gone("Right"), 0);
}

TEST_P(BeforeStop, NothingIsDoneAfterAFault) {
  EXPECT_EQ(finish(RunEnd::kFaulted), "");
  EXPECT_EQ(finish(RunEnd::kStoppedByReaction), "");
  EXPECT_EQ(steps_gone("Left"), 0);
  EXPECT_THAT(log_, HasSubstr("'Left.home' is left out, since something has faulted"));
}

TEST_P(BeforeStop, AFaultOfAShadowIsNoneOfIt) {
  component::Component& shadow = *application_->find("Shadow");
  ASSERT_TRUE(application_->run_in_thread_of(shadow, [&shadow] { shadow.fault("broken"); }));
  application_->run_for(10ms);
  EXPECT_EQ(shadow.state(), component::State::kException);
  EXPECT_EQ(finish(), "");
  EXPECT_EQ(steps_gone("Right"), 5);
  EXPECT_EQ(application_->faults(), 0u);
}

TEST_P(BeforeStop, AFaultEndsItAndNothingFollows) {
  set("Left", "steps", Value::of(-1));
  EXPECT_THAT(finish(), HasSubstr("before the stop, 'Left.home' was ended by a fault"));
  EXPECT_EQ(steps_gone("Right"), 0);
}

TEST_P(BeforeStop, ARefusalIsToldAndTheNextFollows) {
  set("Left", "steps", Value::of(2000));
  EXPECT_THAT(finish(), HasSubstr("'Left.home' was refused: home is too far away"));
  EXPECT_EQ(steps_gone("Right"), 5);
}

TEST_P(BeforeStop, WhatDoesNotEndInTimeIsToldAndGivenUp) {
  set("Left", "holds", Value::of(true));
  EXPECT_THAT(finish(), HasSubstr("'Left.home' did not end within 1 s"));
  EXPECT_EQ(steps_gone("Right"), 5);
}

/// What holds a load lets go of it in no silence.
class Holding : public ::testing::TestWithParam<bool> {
 protected:
  void start(bool goes_first, OnFault on_fault = OnFault::kStopDependents) {
    Blueprint blueprint;
    blueprint.add<Load>("Load", Activity::periodic(1ms));
    blueprint.add<Arm>("Arm", Activity::periodic(1ms));
    blueprint.add<Clock>("Clock", Activity::periodic(1ms));
    blueprint.add<Relay>("Relay");
    blueprint.components[0].peers = {{"Relay", {}}};
    blueprint.components[3].peers = {{"Clock", {}}};
    ApplicationOptions options = patient(GetParam());
    if (goes_first) options.before_stop = {{"Load", "put_down"}};
    options.before_stop_limit = 1s;
    options.hold_at_stop = 300ms;
    options.on_fault = on_fault;
    options.log = [this](const rt::LogRecord& record) { log_ += record.message() + "\n"; };
    application_.emplace(std::move(blueprint), std::move(options));
    ASSERT_EQ(application_->start().to_text(), "");
  }
  void set(const char* property, bool value) {
    const auto done = application_->set_property("Load", property, Value::of(value));
    EXPECT_TRUE(done) << done.error();
  }
  component::State state() { return application_->find("Load")->state(); }

  std::string log_;
  std::optional<Application> application_;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, Holding, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(Holding, WhatIsHeldIsHeldUntilTheTimeIsOverAndThatIsAnErrorThatNamesIt) {
  start(false);
  EXPECT_EQ(application_->run_before_stop(RunEnd::kTimeUp).to_text(), "");
  const base::Time begin = application_->now();
  EXPECT_THAT(application_->hold_until_told().to_text(),
              HasSubstr("error: 'Load' lets go, since no answer came: it held a load; say "
                        "`put_down`, or hold it"));
  EXPECT_GE(application_->now() - begin, 300ms);
  EXPECT_EQ(state(), component::State::kRunning) << "it is stopped by whoever asked";
  EXPECT_THAT(log_, HasSubstr("before the stop, 'Load' holds a load; say `put_down`, or hold it"));
}

TEST_P(Holding, WhatIsDeclaredIsDoneFirstAndNobodyIsAsked) {
  start(true);
  EXPECT_EQ(application_->run_before_stop(RunEnd::kTimeUp).to_text(), "");
  EXPECT_TRUE(application_->held().empty());
  EXPECT_EQ(application_->hold_until_told().to_text(), "");
  EXPECT_EQ(log_, "");
}

TEST_P(Holding, WhatHoldsNothingDoesNothingBeforeTheStop) {
  start(true);
  set("held", false);
  set("stuck", true);
  EXPECT_EQ(application_->run_before_stop(RunEnd::kTimeUp).to_text(), "");
}

TEST_P(Holding, ItEndsWithTheOperatorsWord) {
  start(false);
  const base::Time begin = application_->now();
  int asked = 0;
  const auto converse = [&](base::Duration limit) {
    EXPECT_EQ(limit, 300ms);
    ++asked;
    set("in_my_hands", true);
    return false;
  };
  EXPECT_EQ(application_->hold_until_told(nullptr, converse).to_text(), "");
  EXPECT_EQ(asked, 1);
  EXPECT_LT(application_->now() - begin, 300ms);
}

/// In simulated time a thread that hangs is that of the test.
TEST(HoldingByAThreadThatHangs, IsNotWaitedForAndIsAnError) {
  Blueprint blueprint;
  blueprint.add<Load>("Load", Activity::periodic(1ms));
  ApplicationOptions options = patient(false);
  options.hook_limit = 20ms;
  options.hold_at_stop = 24h;
  Application application(std::move(blueprint), std::move(options));
  ASSERT_EQ(application.start().to_text(), "");
  hangs = true;
  while (!hanging) {  // a thread that is only late answers the next time, and holds on for 24 h
  }
  while (application.held().at(0).answers) {
  }
  EXPECT_THAT(application.hold_until_told().to_text(),
              HasSubstr("error: 'Load' may have held something: its thread does not answer"));
  hangs = false;
  hangs.notify_all();
}

TEST_P(Holding, WhoHasItLetGoIsToldWhatItHeld) {
  start(false);
  const auto quits = [](base::Duration) { return true; };
  EXPECT_THAT(application_->hold_until_told(nullptr, quits).to_text(),
              HasSubstr("error: 'Load' lets go, since it was told to: it held a load"));
  set("in_my_hands", true);
  EXPECT_EQ(application_->hold_until_told(nullptr, quits).to_text(), "");
}

TEST_P(Holding, AlsoAfterAFaultOfAnotherThatEndsTheRun) {
  start(true, OnFault::kStopAll);
  ASSERT_TRUE(application_->run_in_thread_of(
      *application_->find("Arm"), [this] { application_->find("Arm")->fault("broken"); }));
  ASSERT_EQ(application_->run_for(10ms), RunEnd::kFaulted);
  EXPECT_EQ(application_->run_before_stop(RunEnd::kFaulted).to_text(), "");
  const base::Time begin = application_->now();
  EXPECT_FALSE(application_->hold_until_told().ok());
  EXPECT_GE(application_->now() - begin, 300ms);
}

TEST_P(Holding, AComponentThatIsToStopDoesWhatIsDeclaredFirst) {
  start(true);
  ASSERT_TRUE(application_->stop_component("Load"));
  EXPECT_EQ(state(), component::State::kRunning);
  application_->run_until(application_->now() + 10s,
                          [this] { return state() == component::State::kStopped; });
  EXPECT_EQ(state(), component::State::kStopped);
  EXPECT_THAT(log_, HasSubstr("'Load' stops when 'Load.put_down' is done"));
}

TEST_P(Holding, AComponentThatHoldsSomethingIsNotStoppedWithoutAWord) {
  start(false);
  const auto refused = application_->stop_component("Load");
  EXPECT_FALSE(refused);
  EXPECT_EQ(refused.reason(),
            "'Load' was not stopped, since it holds a load; say `put_down`, or hold it");
  set("in_my_hands", true);
  EXPECT_TRUE(application_->stop_component("Load"));
  EXPECT_EQ(state(), component::State::kStopped);
}

TEST_P(Holding, WhoKeepsItHoldingIsNotStoppedEither) {
  start(false);
  for (const char* name : {"Relay", "Clock"}) {
    const auto refused = application_->stop_component(name);
    EXPECT_FALSE(refused);
    EXPECT_EQ(refused.reason(), "'" + std::string(name) +
                                    "' was not stopped, since 'Load' needs it and holds a load; "
                                    "say `put_down`, or hold it; or stop 'Load' first");
    EXPECT_EQ(application_->find(name)->state(), component::State::kRunning);
  }
  EXPECT_TRUE(application_->stop_component("Arm")) << "nobody needs it";
  set("held", false);
  EXPECT_TRUE(application_->stop_component("Clock"));
}

TEST_P(Holding, AComponentWhoseWayIsRefusedIsNotStopped) {
  start(true);
  set("stuck", true);
  const auto refused = application_->stop_component("Load");
  EXPECT_FALSE(refused);
  EXPECT_THAT(std::string(refused.reason()),
              HasSubstr("('Load.put_down' was refused: it is stuck)"));
  EXPECT_EQ(state(), component::State::kRunning);
}

}  // namespace
}  // namespace armature::exec
