// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/engine.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/exec/internal/test_components.hpp"
#include "armature/exec/task.hpp"
#include "armature/rt/guard.hpp"

namespace armature::exec {
namespace {

using component::State;
using ::testing::ElementsAre;

constexpr base::Time at(base::Duration time) { return base::Time(time); }

/// Configures and starts components in the contexts they have.
template <typename... Components>
void start(Components&... components) {
  const auto start_one = [](component::Component& each) {
    ASSERT_TRUE(component::Host::configure(each));
    ASSERT_TRUE(component::Host::start(each));
  };
  (start_one(components), ...);
}

/// An engine with one component that is updated, stepped by the test.
class EngineTest : public ::testing::Test {
 protected:
  explicit EngineTest(Activity activity = Activity::periodic(10ms))
      : engine_("thread", std::move(activity), {&probe_}, {&probe_}) {
    probe_.journal = &journal_;
    start(probe_);
    engine_.begin(at(0ms));
    journal_.take();
  }
  void post(std::string entry) {
    Task::post(engine_.context(), [this, entry] { journal_.note(entry); });
  }

  Journal journal_;
  Probe probe_{"Probe"};
  Engine engine_;
};

// --- periodic ------------------------------------------------------------------------------------

TEST_F(EngineTest, ACycleIsRunWhenItIsDueAndNotBefore) {
  EXPECT_EQ(engine_.next_due(), at(10ms));
  engine_.step(at(9ms));
  EXPECT_THAT(journal_.take(), ElementsAre());
  engine_.step(at(10ms));
  EXPECT_THAT(journal_.take(), ElementsAre("Probe update"));
  EXPECT_EQ(engine_.cycles_run(), 1u);
  EXPECT_EQ(engine_.next_due(), at(20ms));
}

TEST_F(EngineTest, MessagesComeBeforeTheUpdateAndThoseItSendsAfterIt) {
  probe_.actions["update"] = [&] { post("sent by the update"); };
  post("first");
  post("second");
  engine_.step(at(10ms));
  EXPECT_THAT(journal_.take(),
              ElementsAre("first", "second", "Probe update", "sent by the update"));
}

TEST_F(EngineTest, MessagesAreHandledBetweenTwoCyclesToo) {
  post("between");
  EXPECT_TRUE(engine_.has_messages());
  engine_.step(at(12ms - 5ms));
  EXPECT_FALSE(engine_.has_messages());
  EXPECT_THAT(journal_.take(), ElementsAre("between"));
  EXPECT_EQ(probe_.time(), at(7ms));
  EXPECT_EQ(engine_.cycles_run(), 0u);
}

TEST_F(EngineTest, AllThatHappensInACycleHasItsTime) {
  std::vector<base::Time> times;
  probe_.actions["update"] = [&] { times.push_back(probe_.time()); };
  engine_.step(at(10ms + 300us));
  engine_.step(at(20ms + 100us));
  EXPECT_THAT(times, ElementsAre(at(10ms + 300us), at(20ms + 100us)));
}

TEST_F(EngineTest, ASkippedCycleIsCountedAndNotRun) {
  engine_.step(at(35ms));
  EXPECT_THAT(journal_.take(), ElementsAre("Probe update"));
  EXPECT_EQ(engine_.cycles_run(), 1u);
  EXPECT_EQ(engine_.cycles_skipped(), 2u);
  EXPECT_EQ(engine_.latency_ns().summary().most,
            static_cast<std::uint64_t>(base::Duration(25ms).count()));
}

TEST_F(EngineTest, ComponentsThatKeepSendingToThemselvesDoNotHoldUpTheCycle) {
  std::function<void()> again = [&] { Task::post(engine_.context(), again); };
  again();
  engine_.step(at(10ms));
  EXPECT_THAT(journal_.take(), ElementsAre("Probe update"));
  EXPECT_TRUE(engine_.has_messages()) << "the rest waits for the next wake-up";
  again = [] {};
  engine_.step(at(11ms));
  engine_.step(at(12ms));
}

TEST_F(EngineTest, UpdatesRunInTheGivenOrder) {
  Journal journal;
  Probe first("first");
  Probe second("second");
  Engine engine("thread", Activity::periodic(1ms), {&first, &second}, {&second, &first});
  first.journal = second.journal = &journal;
  start(first, second);
  journal.take();
  engine.begin(at(0ms));
  engine.step(at(1ms));
  EXPECT_THAT(journal.take(), ElementsAre("second update", "first update"));
}

TEST_F(EngineTest, TheGuardKnowsThreadAndComponentOfWhatRuns) {
  std::string who;
  bool realtime = false;
  probe_.actions["update"] = [&] {
    const rt::GuardState& state = rt::guard_state();
    who = std::string(state.thread) + "/" + state.running_component(state.context);
    realtime = state.realtime_depth > 0;
  };
  engine_.step(at(10ms));
  EXPECT_EQ(who, "thread/Probe");
  EXPECT_TRUE(realtime);
  EXPECT_EQ(rt::guard_state().context, nullptr);
  EXPECT_EQ(rt::guard_state().realtime_depth, 0);
}

TEST_F(EngineTest, EachCycleIsOneEntryInTheStatisticsWithTheMessagesUpToTheNext) {
  probe_.actions["update"] = [] {};
  for (int cycle = 1; cycle <= 3; ++cycle) {
    engine_.step(at(cycle * 10ms));
    post("between");
    engine_.step(at(cycle * 10ms + 5ms));
  }
  EXPECT_EQ(engine_.cycle_ticks().summary().count, 2u) << "the third is not over";
  engine_.close_account();
  EXPECT_EQ(engine_.cycle_ticks().summary().count, 3u);
}

TEST_F(EngineTest, ExecutionTimesAreTakenInEveryNthCycleAndIncludeMessages) {
  engine_.measure_every(2);
  for (int cycle = 1; cycle <= 6; ++cycle) {
    engine_.step(at(cycle * 10ms));
    Task::post(engine_.context(), [&] { component::Host::run(probe_, engine_.context(), [] {}); });
    engine_.step(at(cycle * 10ms + 5ms));
  }
  engine_.close_account();
  EXPECT_EQ(component::Host::execution_ticks(probe_).summary().count, 3u) << "cycles 2, 4 and 6";
}

// --- policies for late cycles --------------------------------------------------------------------

class CatchingUp : public EngineTest {
 protected:
  static Activity activity() {
    Activity activity = Activity::periodic(10ms);
    activity.overrun = Overrun::kCatchUp;
    return activity;
  }
  CatchingUp() : EngineTest(activity()) {}
};

TEST_F(CatchingUp, RunsEachCycleWithATimeOfItsOwn) {
  std::vector<base::Time> times;
  probe_.actions["update"] = [&] { times.push_back(probe_.time()); };
  engine_.step(at(10ms + 2ms));
  engine_.step(at(45ms));
  EXPECT_THAT(times, ElementsAre(at(12ms), at(25ms), at(35ms), at(45ms)));
  EXPECT_EQ(engine_.cycles_run(), 4u);
  EXPECT_EQ(engine_.cycles_skipped(), 0u);
}

TEST_F(CatchingUp, TimesGoForwardHoweverLateTheCyclesAre) {
  base::Time last = at(0ms);
  probe_.actions["update"] = [&] {
    EXPECT_GT(probe_.time(), last);
    last = probe_.time();
  };
  for (const base::Duration now : {19ms, 20ms, 49ms, 50ms, 51ms, 60ms, 199ms, 200ms}) {
    engine_.step(at(now));
  }
  EXPECT_EQ(engine_.cycles_run(), 20u);
}

class Faulting : public EngineTest {
 protected:
  static Activity activity() {
    Activity activity = Activity::periodic(10ms);
    activity.overrun = Overrun::kFault;
    activity.late_cycles_to_fault = 3;
    return activity;
  }
  Faulting() : EngineTest(activity()) {}
};

TEST_F(Faulting, HappensAfterTheDeclaredNumberOfLateCyclesInARow) {
  engine_.step(at(20ms));
  engine_.step(at(40ms));
  EXPECT_EQ(probe_.state(), State::kRunning);
  engine_.step(at(60ms));
  EXPECT_EQ(probe_.state(), State::kException);
  EXPECT_EQ(probe_.reason(), "its thread missed too many cycles in a row");
}

TEST_F(Faulting, LeavesThoseAloneThatAreNotInService) {
  probe_.stop();
  for (int cycle = 1; cycle <= 5; ++cycle) engine_.step(at(cycle * 20ms));
  EXPECT_EQ(probe_.state(), State::kStopped);
}

TEST_F(Faulting, ACycleInTimeBeginsTheCountAgain) {
  for (int round = 0; round < 5; ++round) {
    engine_.step(at(round * 50ms + 20ms));
    engine_.step(at(round * 50ms + 40ms));
    engine_.step(at(round * 50ms + 50ms));
  }
  EXPECT_EQ(probe_.state(), State::kRunning);
}

// --- triggered -----------------------------------------------------------------------------------

class TriggeredEngine : public EngineTest {
 protected:
  TriggeredEngine() : EngineTest(Activity::triggered()) {}
};

TEST_F(TriggeredEngine, HasNothingToDoByItself) {
  EXPECT_EQ(engine_.next_due(), base::Time::max());
  EXPECT_FALSE(engine_.has_messages());
}

TEST_F(TriggeredEngine, EachWakeUpWithMessagesIsACycle) {
  post("a");
  post("b");
  engine_.step(at(1ms));
  post("c");
  engine_.step(at(2ms));
  EXPECT_THAT(journal_.take(), ElementsAre("a", "b", "c"));
  EXPECT_EQ(engine_.cycles_run(), 2u);
  EXPECT_EQ(engine_.cycle_ticks().summary().count, 2u);
}

TEST_F(TriggeredEngine, AWakeUpForNothingIsNone) {
  engine_.step(at(1ms));
  EXPECT_EQ(engine_.cycles_run(), 0u);
  EXPECT_EQ(probe_.time(), at(0ms));
}

/// Reads something that must not be old.
class Watcher final : public component::Component {
 public:
  using Component::Component;
  component::InputPort<double> in{this, "In", "must be fresh", "", component::max_age(10ms)};
};

class AgingEngine : public ::testing::Test {
 protected:
  AgingEngine()
      : writers_("writer", Activity::periodic(1ms), {&writer_}, {&writer_}),
        engine_("watcher", Activity::triggered(), {&watcher_}, {}) {
    face(writer_.out).connect(face(watcher_.in), {});
    start(writer_, watcher_);
    writers_.begin(at(0ms));
    engine_.begin(at(0ms));
    writer_.actions["update"] = [this] { writer_.out.write(1.0); };
  }

  Probe writer_{"Writer"};
  Watcher watcher_{"Watcher"};
  Engine writers_;
  Engine engine_;
};

TEST_F(AgingEngine, WakesWhenItsDataBecomesTooOldAndReactsThen) {
  engine_.step(at(0ms));
  EXPECT_EQ(engine_.next_due(), at(10ms + 1ns)) << "counts from the start";
  writers_.step(at(4ms));
  engine_.step(at(10ms + 1ns));
  EXPECT_EQ(watcher_.state(), State::kRunning);
  EXPECT_EQ(engine_.next_due(), at(14ms + 1ns));
  engine_.step(at(14ms));
  EXPECT_EQ(watcher_.state(), State::kRunning);
  engine_.step(at(14ms + 1ns));
  EXPECT_EQ(watcher_.state(), State::kStopped);
  EXPECT_EQ(watcher_.reason(), "input 'In': its data is older than declared");
  EXPECT_EQ(engine_.next_due(), base::Time::max()) << "it has nothing to watch any more";
}

TEST_F(AgingEngine, OneThatStartsLaterIsWatchedFromThenOn) {
  watcher_.stop();
  engine_.step(at(0ms));
  EXPECT_EQ(engine_.next_due(), base::Time::max());
  Task::post(engine_.context(), [this] { EXPECT_TRUE(component::Host::start(watcher_)); });
  engine_.step(at(50ms));
  EXPECT_EQ(engine_.next_due(), at(60ms + 1ns));
}

}  // namespace
}  // namespace armature::exec
