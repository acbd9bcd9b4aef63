// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/rt/log.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

/// Brings the component to `state` by allowed transitions, and forgets how.
void bring_to(State state, ProbeComponent& component) {
  if (state != State::kPreOperational) {
    ASSERT_TRUE(Host::configure(component));
  }
  if (state > State::kStopped) {
    ASSERT_TRUE(Host::start(component));
  }
  if (state == State::kRunTimeError) component.error("for the test");
  if (state == State::kException) component.fault("for the test");
  ASSERT_EQ(component.state(), state);
  component.calls.clear();
}

class LifeCycle : public testing::Test {
 protected:
  LifeCycle() : thread_(component_) { thread_.context.supervisor = &supervisor_; }

  void bring_to(State state) { component::bring_to(state, component_); }

  ProbeComponent component_{"probe"};
  TestSupervisor supervisor_;
  TestThread thread_;
};

TEST_F(LifeCycle, GoesThroughAllStatesAndBack) {
  EXPECT_EQ(component_.state(), State::kPreOperational);
  EXPECT_TRUE(Host::configure(component_));
  EXPECT_EQ(component_.state(), State::kStopped);
  EXPECT_TRUE(Host::activate(component_));
  EXPECT_EQ(component_.state(), State::kStopped);
  EXPECT_TRUE(Host::start(component_));
  EXPECT_EQ(component_.state(), State::kRunning);
  Host::update(component_);
  Host::stop(component_);
  EXPECT_EQ(component_.state(), State::kStopped);
  Host::cleanup(component_);
  EXPECT_EQ(component_.state(), State::kPreOperational);
  EXPECT_THAT(component_.calls,
              ElementsAre("configure", "activate", "start", "update", "stop", "cleanup"));
}

TEST_F(LifeCycle, UpdateRunsOnlyWhenItIsTriggered) {
  bring_to(State::kRunning);
  thread_.cycle();
  EXPECT_THAT(component_.calls, ElementsAre()) << "neither at the start nor after messages";
  Host::update(component_);
  Host::update(component_);
  EXPECT_THAT(component_.calls, ElementsAre("update", "update"));
}

struct Transition {
  const char* name;
  Outcome (*apply)(Component&);
  State from;
};

TEST_F(LifeCycle, EachTransitionIsRefusedFromEveryOtherStateWithBothNamesAndTheReasonForTheState) {
  const std::vector<Transition> steps{
      {"configure", [](Component& c) { return Host::configure(c); }, State::kPreOperational},
      {"activate", [](Component& c) { return Host::activate(c); }, State::kStopped},
      {"start", [](Component& c) { return Host::start(c); }, State::kStopped},
      {"recover", [](Component& c) { return Host::recover(c); }, State::kRunTimeError},
      {"reset", [](Component& c) { return Host::reset(c); }, State::kException}};
  for (const State state : {State::kPreOperational, State::kStopped, State::kRunning,
                            State::kRunTimeError, State::kException}) {
    for (const Transition& step : steps) {
      if (step.from == state) continue;
      ProbeComponent component("other");
      thread_.add(component);
      component::bring_to(state, component);
      const Outcome outcome = step.apply(component);
      EXPECT_FALSE(outcome) << step.name << " from " << name_of(state);
      const bool why = state == State::kRunTimeError || state == State::kException;
      EXPECT_EQ(outcome.reason(), std::string("cannot ") + step.name + " while " +
                                      std::string(name_of(state)) + (why ? ": for the test" : ""));
      EXPECT_EQ(component.state(), state);
      EXPECT_THAT(component.calls, ElementsAre());
    }
  }
}

TEST_F(LifeCycle, StopDoesNothingToWhatDoesNotRun) {
  for (const State state : {State::kPreOperational, State::kStopped, State::kException}) {
    ProbeComponent component("other");
    component::bring_to(state, component);
    Host::stop(component);
    EXPECT_EQ(component.state(), state);
    EXPECT_THAT(component.calls, ElementsAre());
  }
}

TEST_F(LifeCycle, CleanupDoesNothingToWhatIsNotStopped) {
  bring_to(State::kRunning);
  Host::cleanup(component_);
  EXPECT_EQ(component_.state(), State::kRunning);
  component_.fault("for the test");
  Host::cleanup(component_);
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_THAT(component_.calls, ElementsAre());
}

TEST_F(LifeCycle, ARefusedConfigurationLeavesTheStateAndSaysWhy) {
  component_.refusals["configure"] = "no card answers on can0";
  const Outcome outcome = Host::configure(component_);
  EXPECT_FALSE(outcome);
  EXPECT_EQ(outcome.reason(), "no card answers on can0");
  EXPECT_EQ(component_.reason(), "no card answers on can0");
  EXPECT_EQ(component_.state(), State::kPreOperational);
}

TEST_F(LifeCycle, ARefusedActivationStartOrResetLeavesTheStateAndSaysWhy) {
  bring_to(State::kStopped);
  component_.refusals = {{"activate", "a"}, {"start", "b"}, {"reset", "c"}};
  EXPECT_EQ(Host::activate(component_).reason(), "a");
  EXPECT_EQ(component_.state(), State::kStopped);
  EXPECT_EQ(Host::start(component_).reason(), "b");
  EXPECT_EQ(component_.state(), State::kStopped);
  component_.fault("broken");
  EXPECT_EQ(Host::reset(component_).reason(), "c");
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_EQ(component_.reason(), "c");
}

TEST_F(LifeCycle, ASuccessForgetsTheReasonOfAnEarlierRefusal) {
  component_.refusals["configure"] = "not yet";
  EXPECT_FALSE(Host::configure(component_));
  component_.refusals.clear();
  EXPECT_TRUE(Host::configure(component_));
  EXPECT_EQ(component_.reason(), "");
}

TEST_F(LifeCycle, TheErrorHookRunsInPlaceOfTheUpdateHookUntilRecovery) {
  bring_to(State::kRunning);
  component_.error("following error too large");
  EXPECT_EQ(component_.state(), State::kRunTimeError);
  EXPECT_EQ(component_.reason(), "following error too large");
  Host::update(component_);
  Host::update(component_);
  EXPECT_TRUE(Host::recover(component_));
  EXPECT_EQ(component_.state(), State::kRunning);
  EXPECT_EQ(component_.reason(), "");
  Host::update(component_);
  EXPECT_THAT(component_.calls, ElementsAre("error", "error", "update"));
}

TEST_F(LifeCycle, AnErrorOfWhatDoesNotRunIsNone) {
  bring_to(State::kStopped);
  component_.error("ignored");
  EXPECT_EQ(component_.state(), State::kStopped);
  EXPECT_EQ(component_.reason(), "");
}

TEST_F(LifeCycle, StopsFromRunTimeError) {
  bring_to(State::kRunTimeError);
  Host::stop(component_);
  EXPECT_EQ(component_.state(), State::kStopped);
  EXPECT_THAT(component_.calls, ElementsAre("stop"));
}

TEST_F(LifeCycle, AtTheApplicationsEndAFaultedComponentIsCleanedUpToo) {
  bring_to(State::kRunning);
  component_.fault("for the test");
  Host::retire(component_);
  EXPECT_EQ(component_.state(), State::kPreOperational);
  EXPECT_EQ(component_.reason(), "for the test") << "for whoever asks afterwards";
  EXPECT_THAT(component_.calls, ElementsAre("cleanup"));
}

TEST_F(LifeCycle, AtTheApplicationsEndWhatWasNeverConfiguredIsNotCleanedUp) {
  component_.actions["configure"] = [] { throw std::runtime_error("no card"); };
  EXPECT_FALSE(Host::configure(component_));
  Host::retire(component_);
  EXPECT_EQ(component_.state(), State::kPreOperational);
  EXPECT_THAT(component_.calls, ElementsAre("configure"));
}

TEST_F(LifeCycle, AFaultIsLeftOnlyByResetAndThenStopped) {
  bring_to(State::kRunning);
  component_.fault("motor does not turn");
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_EQ(component_.reason(), "motor does not turn");
  EXPECT_FALSE(component_.ready());
  Host::update(component_);
  Host::stop(component_);
  Host::cleanup(component_);
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_TRUE(Host::reset(component_));
  EXPECT_EQ(component_.state(), State::kStopped);
  EXPECT_EQ(component_.reason(), "");
  EXPECT_THAT(component_.calls, ElementsAre("reset"));
  EXPECT_THAT(supervisor_.faulted, ElementsAre("probe"));
}

TEST_F(LifeCycle, ASecondFaultKeepsTheFirstReason) {
  bring_to(State::kRunning);
  component_.fault("first");
  component_.fault("second");
  EXPECT_EQ(component_.reason(), "first");
  EXPECT_THAT(supervisor_.faulted, ElementsAre("probe"));
}

TEST_F(LifeCycle, ResetOfWhatWasNeverConfiguredDoesNotMakeItConfigured) {
  component_.actions["configure"] = [] { throw std::runtime_error("no such file"); };
  EXPECT_FALSE(Host::configure(component_));
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_TRUE(Host::reset(component_));
  EXPECT_EQ(component_.state(), State::kPreOperational);
}

TEST_F(LifeCycle, AHookThatFaultsItsComponentDoesNotReachTheNextState) {
  component_.actions["configure"] = [this] { component_.fault("found out while configuring"); };
  const Outcome outcome = Host::configure(component_);
  EXPECT_FALSE(outcome);
  EXPECT_EQ(outcome.reason(), "found out while configuring");
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_EQ(component_.reason(), "found out while configuring");
}

TEST_F(LifeCycle, AResetHookThatFaultsAgainDoesNotLeaveTheException) {
  bring_to(State::kRunning);
  component_.fault("first");
  component_.actions["reset"] = [this] { component_.fault("still broken"); };
  EXPECT_EQ(Host::reset(component_).reason(), "still broken");
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_EQ(component_.reason(), "still broken");
}

TEST_F(LifeCycle, AComponentMayStopItselfInItsUpdate) {
  bring_to(State::kRunning);
  component_.actions["update"] = [this] { Host::stop(component_); };
  Host::update(component_);
  EXPECT_EQ(component_.state(), State::kStopped);
  EXPECT_THAT(component_.calls, ElementsAre("update", "stop"));
}

TEST_F(LifeCycle, RestartsAfterAStop) {
  bring_to(State::kRunning);
  Host::stop(component_);
  EXPECT_TRUE(Host::start(component_));
  Host::update(component_);
  EXPECT_EQ(component_.state(), State::kRunning);
  EXPECT_THAT(component_.calls, ElementsAre("stop", "start", "update"));
}

TEST_F(LifeCycle, StoppingByADeclaredReactionTellsTheApplicationWhy) {
  bring_to(State::kRunning);
  component_.stop_because("input 'reference': its data is older than declared");
  EXPECT_EQ(component_.state(), State::kStopped);
  EXPECT_EQ(component_.reason(), "input 'reference': its data is older than declared");
  EXPECT_THAT(supervisor_.stopped, ElementsAre("probe"));
  EXPECT_THAT(supervisor_.faulted, ElementsAre());
}

TEST_F(LifeCycle, TooLongAReasonIsCutNotLost) {
  component_.refusals["configure"] = std::string(1000, 'x');
  EXPECT_EQ(Host::configure(component_).reason(), std::string(511, 'x'));
}

TEST(LifeCycleNames, AreThoseOfTheDocumentation) {
  EXPECT_EQ(name_of(State::kPreOperational), "PreOperational");
  EXPECT_EQ(name_of(State::kStopped), "Stopped");
  EXPECT_EQ(name_of(State::kRunning), "Running");
  EXPECT_EQ(name_of(State::kRunTimeError), "RunTimeError");
  EXPECT_EQ(name_of(State::kException), "Exception");
}

// --- exceptions ----------------------------------------------------------------------------------

class Containment : public LifeCycle {};

struct HookCase {
  const char* hook;
  State from;
  void (*run)(Component&);
};

const std::vector<HookCase>& hook_cases() {
  static const std::vector<HookCase> cases{
      {"configure", State::kPreOperational, [](Component& c) { EXPECT_FALSE(Host::configure(c)); }},
      {"activate", State::kStopped, [](Component& c) { EXPECT_FALSE(Host::activate(c)); }},
      {"start", State::kStopped, [](Component& c) { EXPECT_FALSE(Host::start(c)); }},
      {"update", State::kRunning, [](Component& c) { Host::update(c); }},
      {"stop", State::kRunning, [](Component& c) { Host::stop(c); }},
      {"cleanup", State::kStopped, [](Component& c) { Host::cleanup(c); }},
      {"error", State::kRunTimeError, [](Component& c) { Host::update(c); }},
      {"reset", State::kException, [](Component& c) { EXPECT_FALSE(Host::reset(c)); }}};
  return cases;
}

class ContainmentInHook : public LifeCycle, public testing::WithParamInterface<std::size_t> {};

TEST_P(ContainmentInHook, AnExceptionFaultsTheComponentAndTheProcessGoesOn) {
  const HookCase& hook = hook_cases()[GetParam()];
  bring_to(hook.from);
  component_.actions[hook.hook] = [] { throw std::runtime_error("card 3 is gone"); };
  hook.run(component_);
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_EQ(component_.reason(), "exception: card 3 is gone");
  EXPECT_THAT(supervisor_.faulted, ElementsAre("probe"));
  EXPECT_EQ(thread_.context.running(), nullptr);
}

TEST_P(ContainmentInHook, AnExceptionOfAnUnknownTypeToo) {
  const HookCase& hook = hook_cases()[GetParam()];
  bring_to(hook.from);
  component_.actions[hook.hook] = [] { throw 42; };
  hook.run(component_);
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_EQ(component_.reason(), "exception of an unknown type");
}

INSTANTIATE_TEST_SUITE_P(AllEight, ContainmentInHook,
                         testing::Range<std::size_t>(0, hook_cases().size()),
                         [](const auto& test) { return hook_cases()[test.param].hook; });

TEST_F(Containment, NothingOfAFaultedComponentRuns) {
  bring_to(State::kRunning);
  component_.actions["update"] = [] { throw std::runtime_error("once"); };
  Host::update(component_);
  Host::update(component_);
  EXPECT_THAT(component_.calls, ElementsAre("update"));
}

TEST_F(Containment, TheLogNamesTheComponentAndTheReason) {
  rt::LogQueue log(4);
  thread_.context.log = &log;
  bring_to(State::kRunning);
  component_.actions["update"] = [] { throw std::runtime_error("card 3 is gone"); };
  Host::update(component_);
  const rt::LogRecord* record = log.pop();
  ASSERT_NE(record, nullptr);
  EXPECT_EQ(record->level, rt::LogLevel::kError);
  EXPECT_EQ(record->component.view(), "probe");
  EXPECT_EQ(record->message(), "fault: exception: card 3 is gone");
  EXPECT_EQ(log.pop(), nullptr);
}

TEST_F(Containment, TheLogHasAllOfAnExceptionThatIsLongerThanAReason) {
  rt::LogQueue log(8);
  thread_.context.log = &log;
  bring_to(State::kRunning);
  std::string what;
  for (int i = 0; i < 400; ++i) what += std::to_string(i) + " ";
  component_.actions["update"] = [&] { throw std::runtime_error(what); };
  Host::update(component_);
  std::string told;
  while (const rt::LogRecord* record = log.pop()) {
    const std::string line = record->message();
    for (const char* begin : {"fault: exception: ", "rest of the exception: "}) {
      if (line.starts_with(begin)) told += line.substr(std::string(begin).size());
    }
  }
  EXPECT_EQ(told, what);
}

TEST_F(Containment, AComponentThatThrowsWhileADeclaredReactionStopsItKeepsTheException) {
  bring_to(State::kRunning);
  component_.actions["stop"] = [] { throw std::runtime_error("brake stuck"); };
  component_.stop_because("its data is old");
  EXPECT_EQ(component_.state(), State::kException);
  EXPECT_EQ(component_.reason(), "exception: brake stuck");
  EXPECT_THAT(supervisor_.faulted, ElementsAre("probe"));
}

}  // namespace
}  // namespace armature::component
