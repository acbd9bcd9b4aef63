// SPDX-License-Identifier: Apache-2.0
// Modes of an application that runs: which components do, and what a switch does to them.
#include "armature/exec/modes.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/face.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using component::State;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using types::Value;

/// Writes its own number in each cycle; remembers what it took over.
class Actor : public Probe {
 public:
  using Probe::Probe;
  double number = 0.0;
  std::optional<double> taken_over;

  component::EventHandler<std::int64_t> tick{this, "Tick", component::serve<&Actor::on_tick>, ""};
  component::OutputPort<double> act{this, "Act", "its number"};

 private:
  void on_tick(std::int64_t) { act.write(number); }
  component::Outcome on_start() override {
    const double* const value = act.taken_over();
    taken_over = value == nullptr ? std::nullopt : std::optional<double>(*value);
    return answer("start");
  }
};

/// What the actors drive.
class Motor : public component::Component {
 public:
  using Component::Component;
  std::vector<double> driven;
  component::InputPort<double> act{
      this, "Act", "", "", component::on_data<&Motor::drive>, component::max_age(15ms)};

 private:
  void drive(double value) {
    const rt::PermitScope what_a_test_does_is_no_real_time_code;
    driven.push_back(value);
  }
};

class Supervisor : public component::Component {
 public:
  using Component::Component;
  component::CommandCaller<ModeName> switcher{this, "switch", "to another mode"};
  component::EventHandler<ModeName> switched{
      this, "Switched", component::serve<&Supervisor::on_switched>, "", component::optional};
  std::string wanted;
  std::vector<std::string> seen;

 private:
  void on_update() override {
    if (!wanted.empty()) handle_ = switcher.send(ModeName(std::exchange(wanted, {})));
  }
  void on_switched(const ModeName& mode) {
    const rt::PermitScope what_a_test_does_is_no_real_time_code;
    seen.emplace_back(mode.view());
  }
  component::CommandHandle handle_{component::CallStatus::kNotConnected};
};

/// Ticks each 10 ms; A and its helper in mode "a", B in "b", C in both, and a motor.
class InModes : public ::testing::TestWithParam<bool> {
 protected:
  InModes() {
    blueprint.add<Counter>("Clock", Activity::periodic(10ms));
    helper = &blueprint.add<Probe>("Helper");
    a = &add_actor("A", 1.0);
    b = &add_actor("B", 2.0);
    second = &blueprint.add<Probe>("Second");
    motor = &blueprint.add<Motor>("Motor");
    // A machine that is busy with other things may leave out cycles.
    if (!GetParam()) face(motor->act).set_max_age(component::max_age(10s));
    blueprint.connect("A.Act", "Motor.Act");
    blueprint.connect("B.Act", "Motor.Act");
    blueprint.connect("Helper.Out", "A.In");
    blueprint.connect("B.Out", "Second.In");
    for (Probe* each : {static_cast<Probe*>(a), static_cast<Probe*>(b), helper, second}) {
      each->journal = &journal;
    }
    blueprint.add_mode("a", {{"A", {}}, {"Helper", {}}});
    blueprint.add_mode("b", {{"B", {}}, {"Second", {}}});
    // All that is in modes is called or triggered from the clock's thread.
    keeper = &blueprint.add<Keeper>("Keeper");
    blueprint.add_peer("Keeper", "Clock");
    blueprint.connect("Keeper.Out", "Helper.In");
  }
  class Keeper : public component::Component {
   public:
    using Component::Component;
    component::OutputPort<double> out{this, "Out", ""};
    component::EventHandler<std::int64_t> tick{this, "Tick", component::serve<&Keeper::on_tick>,
                                               ""};

   private:
    void on_tick(std::int64_t) { out.write(0.0); }
  };
  Actor& add_actor(const char* name, double number) {
    Actor& actor = blueprint.add<Actor>(name);
    actor.number = number;
    blueprint.add_peer(name, "Clock");
    return actor;
  }

  void start() {
    for (Probe* each : {static_cast<Probe*>(a), static_cast<Probe*>(b), helper, second}) {
      each->actions["in"] = [] {};
    }
    application.emplace(std::move(blueprint), patient(GetParam()));
    ASSERT_EQ(application->start().to_text(), "");
    journal.take();
  }
  std::vector<std::string> hooks() {
    std::vector<std::string> entries = journal.take();
    std::erase_if(entries, [](const std::string& entry) { return entry.ends_with(" in"); });
    return entries;
  }
  std::string mode() {
    const auto value = application->value_of("Modes", "mode");
    return std::string(static_cast<const ModeName*>(value.value().data())->view());
  }
  bool drives(double number) {
    return run_until(*application, [&] {
      return *static_cast<const double*>(application->value_of("Motor", "Act").value().data()) ==
             number;
    });
  }

  Journal journal;
  Blueprint blueprint;
  Actor* a;
  Actor* b;
  Probe* helper;
  Probe* second;
  Motor* motor;
  Keeper* keeper;
  std::optional<Application> application;
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, InModes, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

TEST_P(InModes, OnlyTheComponentsOfTheFirstRunAndAllAreConfigured) {
  application.emplace(std::move(blueprint), patient(GetParam()));
  ASSERT_EQ(application->start().to_text(), "");
  EXPECT_EQ(mode(), "a");
  EXPECT_EQ(a->state(), State::kRunning);
  EXPECT_EQ(b->state(), State::kStopped);
  const auto entries = journal.take();
  EXPECT_THAT(entries, ::testing::Contains("B configure"));
  EXPECT_THAT(entries, ::testing::Not(::testing::Contains("B start")));
  EXPECT_TRUE(drives(1.0));
}

TEST_P(InModes, AnotherOneMayBeTheInitialOne) {
  blueprint.initial_mode = {"b", {}};
  start();
  EXPECT_EQ(mode(), "b");
  EXPECT_EQ(a->state(), State::kStopped);
  EXPECT_TRUE(drives(2.0));
}

TEST_P(InModes, ASwitchStartsInTheOrderOfTheFlowAndThenStopsInReverse) {
  start();
  ASSERT_TRUE(drives(1.0));
  ASSERT_TRUE(application->switch_mode("b"));
  EXPECT_THAT(hooks(), ElementsAre("B start", "Second start", "A stop", "Helper stop"));
  EXPECT_EQ(mode(), "b");
  EXPECT_TRUE(drives(2.0));
  ASSERT_TRUE(application->switch_mode("a"));
  EXPECT_THAT(hooks(), ElementsAre("Helper start", "A start", "Second stop", "B stop"));
  EXPECT_TRUE(drives(1.0));
  EXPECT_EQ(motor->state(), State::kRunning) << "its data was never too old";
}

TEST_P(InModes, TheNewWriterSeesWhatItTakesOverAndAtNoOtherStart) {
  start();
  ASSERT_TRUE(drives(1.0));
  EXPECT_EQ(a->taken_over, std::nullopt);
  ASSERT_TRUE(application->switch_mode("b"));
  EXPECT_EQ(b->taken_over, 1.0);
  ASSERT_TRUE(drives(2.0));
  ASSERT_TRUE(application->stop_component("B"));
  ASSERT_TRUE(application->start_component("B"));
  EXPECT_EQ(b->taken_over, std::nullopt);
  ASSERT_TRUE(drives(2.0));
  ASSERT_TRUE(application->switch_mode("a"));
  EXPECT_EQ(a->taken_over, 2.0);
}

TEST_P(InModes, WhatAShadowReadsInTurnsIsNotTakenOver) {
  Actor& copy = add_actor("Copy", 7.0);
  copy.journal = &journal;
  blueprint.modes[0].members.push_back({"Copy", {}});
  Motor& mirror = blueprint.add<Motor>("Mirror", Activity::triggered());
  face(mirror.act).set_max_age(component::max_age(10s));
  blueprint.components.back().shadow = true;
  blueprint.connect("Copy.Act", "Mirror.Act");
  blueprint.connect("B.Act", "Mirror.Act");
  start();
  ASSERT_TRUE(drives(1.0));
  ASSERT_TRUE(application->switch_mode("b"));
  EXPECT_EQ(b->taken_over, 1.0) << "of A, who drove";
}

TEST_P(InModes, ARefusedStartUndoesWhatHadStartedAndThePresentModeGoesOn) {
  second->refusals["start"] = "no ink";
  start();
  ASSERT_TRUE(drives(1.0));
  EXPECT_EQ(application->switch_mode("b").reason(), "'Second' refuses to start: no ink");
  EXPECT_THAT(hooks(), ElementsAre("B start", "Second start", "B stop"));
  EXPECT_EQ(mode(), "a");
  EXPECT_EQ(a->state(), State::kRunning);
  second->refusals.clear();
  ASSERT_TRUE(application->switch_mode("b"));
  EXPECT_TRUE(drives(2.0));
}

TEST_P(InModes, AnExceptionInAStartIsARefusal) {
  second->throw_in("start");
  start();
  EXPECT_THAT(std::string(application->switch_mode("b").reason()),
              HasSubstr("'Second' refuses to start: exception: thrown in start"));
  EXPECT_EQ(mode(), "a");
  EXPECT_EQ(a->state(), State::kRunning);
  EXPECT_EQ(motor->state(), State::kRunning);
  EXPECT_EQ(application->switch_mode("b").reason(),
            "'Second' is in Exception: exception: thrown in start");
}

TEST_P(InModes, ToThePresentOneNothingHappens) {
  start();
  EXPECT_TRUE(application->switch_mode("a"));
  EXPECT_THAT(hooks(), ElementsAre());
}

TEST_P(InModes, AStartAgainBeginsInTheInitialOne) {
  start();
  ASSERT_TRUE(drives(1.0));
  ASSERT_TRUE(application->switch_mode("b"));
  ASSERT_TRUE(drives(2.0));
  EXPECT_EQ(application->stop().to_text(), "");
  EXPECT_EQ(application->switch_mode("b").reason(), "the application does not run");
  ASSERT_EQ(application->start().to_text(), "");
  EXPECT_EQ(mode(), "a");
  EXPECT_EQ(b->state(), State::kStopped);
  ASSERT_TRUE(drives(1.0));
}

TEST_P(InModes, WhatWasWrittenBeforeTheApplicationStartedIsNotTakenOver) {
  start();
  if (!GetParam()) GTEST_SKIP() << "a tick may come at once";
  ASSERT_TRUE(drives(1.0));
  application->run_for(5ms);
  application->stop();
  ASSERT_EQ(application->start().to_text(), "");
  ASSERT_TRUE(application->switch_mode("b"));
  EXPECT_EQ(b->taken_over, std::nullopt);
}

TEST_P(InModes, AFaultOfTheOneWhoseTurnItIsStopsTheReaderAndOneOfTheOtherDoesNot) {
  start();
  ASSERT_TRUE(drives(1.0));
  application->run_in_thread_of(*b, [this] { b->fault("broken"); });
  application->run_for(20ms);
  EXPECT_EQ(motor->state(), State::kRunning);
  application->run_in_thread_of(*a, [this] { a->fault("broken"); });
  EXPECT_TRUE(run_until(*application, [this] { return motor->state() == State::kStopped; }));
}

TEST_P(InModes, APeerSwitchesByCommandBetweenTwoCyclesAndIsToldByAnEvent) {
  auto& supervisor = blueprint.add<Supervisor>("Supervisor", Activity::periodic(10ms));
  blueprint.add_peer("Supervisor", "Modes");
  start();
  ASSERT_TRUE(drives(1.0));
  application->run_in_thread_of(supervisor, [&] { supervisor.wanted = "b"; });
  ASSERT_TRUE(drives(2.0));
  std::vector<std::string> seen;
  EXPECT_TRUE(run_until(*application, [&] {
    application->run_in_thread_of(supervisor, [&] { seen = supervisor.seen; });
    return !seen.empty();
  }));
  EXPECT_THAT(seen, ElementsAre("b"));
}

TEST_P(InModes, ACommandThatCannotBeIsRefusedOrFailsWithTheReason) {
  second->refusals["start"] = "no ink";
  start();
  EXPECT_THAT(application->call("Modes", "switch", {Value::of(ModeName("c"))}).error(),
              HasSubstr("unknown mode 'c', known: a, b"));
  const auto handle = application->begin("Modes", "switch", {Value::of(ModeName("b"))});
  ASSERT_TRUE(handle) << handle.error();
  if (GetParam()) {
    const auto again = application->begin("Modes", "switch", {Value::of(ModeName("a"))});
    EXPECT_THAT(again.error(), HasSubstr("the previous command is still under way"));
  }
  EXPECT_TRUE(run_until(*application, [&] { return handle.value().ended(); }));
  EXPECT_EQ(handle.value().stage(), component::CommandStage::kFailed);
  EXPECT_EQ(handle.value().reason(), "'Second' refuses to start: no ink");
}

TEST_P(InModes, NoCycleIsLostAndNothingIsDrivenTwice) {
  start();
  ASSERT_TRUE(drives(1.0));
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(application->switch_mode(k % 2 == 0 ? "b" : "a"));
    application->run_for(std::chrono::milliseconds(3 + 7 * (k % 5)));
  }
  std::size_t driven = 0;
  double cycles = 0.0;
  application->run_in_thread_of(*motor, [&] {
    driven = motor->driven.size();
    cycles = static_cast<double>(application->thread_statistics()[0].cycles_run);
  });
  EXPECT_NEAR(static_cast<double>(driven), cycles, 1.0);
}

TEST(Modes, ApplicationsWithoutThemHaveNoneToSwitch) {
  Blueprint blueprint;
  blueprint.add<Counter>("Clock", Activity::periodic(10ms));
  Application application(std::move(blueprint), patient(true));
  ASSERT_EQ(application.start().to_text(), "");
  EXPECT_EQ(application.switch_mode("a").reason(), "the application has no modes");
}

}  // namespace
}  // namespace armature::exec
