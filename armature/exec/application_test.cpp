// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/application.hpp"

#include <algorithm>
#include <csignal>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec {
namespace {

using component::State;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Three probes A -> B -> C, each noting what happens to it.
struct Chain {
  Journal journal;
  Blueprint blueprint;
  Probe* a;
  Probe* b;
  Probe* c;

  Chain() {
    // Declared against the flow, which is what decides.
    c = &blueprint.add<Probe>("C", Activity::periodic(10ms));
    b = &blueprint.add<Probe>("B", Activity::periodic(10ms));
    a = &blueprint.add<Probe>("A", Activity::periodic(10ms));
    blueprint.connect("A.Out", "B.Look");
    blueprint.connect("B.Out", "C.Look");
    for (Probe* each : {a, b, c}) {
      each->journal = &journal;
      each->actions["update"] = [] {};
    }
  }

  /// What was noted but for the updates.
  std::vector<std::string> life() {
    std::vector<std::string> entries = journal.take();
    std::erase_if(entries, [](const std::string& entry) { return entry.ends_with("update"); });
    return entries;
  }
  std::vector<State> states() const { return {a->state(), b->state(), c->state()}; }
};

class ApplicationTime : public ::testing::TestWithParam<bool> {
 protected:
  static ApplicationOptions options() { return patient(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, ApplicationTime, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

// --- start and stop ------------------------------------------------------------------------------

TEST_P(ApplicationTime, StartsInTheOrderOfTheFlowAndStopsInReverse) {
  Chain chain;
  Application application(std::move(chain.blueprint), options());
  EXPECT_EQ(application.start().to_text(), "");
  EXPECT_TRUE(application.running());
  EXPECT_THAT(chain.life(),
              ElementsAre("A configure", "B configure", "C configure", "A activate", "B activate",
                          "C activate", "A start", "B start", "C start"));
  EXPECT_THAT(chain.states(), ElementsAre(State::kRunning, State::kRunning, State::kRunning));
  EXPECT_EQ(application.stop().to_text(), "");
  EXPECT_FALSE(application.running());
  EXPECT_THAT(chain.life(),
              ElementsAre("C stop", "B stop", "A stop", "C cleanup", "B cleanup", "A cleanup"));
  EXPECT_THAT(application.casualties(), IsEmpty());
}

TEST_P(ApplicationTime, IsReadyAfterEveryStartAndBeforeTheFirstCycle) {
  Chain chain;
  for (Probe* each : {chain.a, chain.b, chain.c}) {
    each->actions["update"] = [&chain] { chain.journal.note("cycle"); };
  }
  ApplicationOptions options = ApplicationTime::options();
  options.ready = [&chain] { chain.journal.note("ready"); };
  Application application(std::move(chain.blueprint), std::move(options));
  ASSERT_EQ(application.start().to_text(), "");
  const auto has_run = [&] { return application.thread_statistics()[0].cycles_run > 0; };
  EXPECT_TRUE(run_until(application, has_run));
  EXPECT_EQ(application.stop().to_text(), "");
  const std::vector<std::string> entries = chain.journal.take();
  ASSERT_GT(entries.size(), 10u);
  EXPECT_EQ(entries[8], "C start");
  EXPECT_EQ(entries[9], "ready");
  EXPECT_EQ(std::count(entries.begin(), entries.end(), "ready"), 1);
}

TEST_P(ApplicationTime, NeighboursOfOneThreadStopInTheSameOrder) {
  Journal journal;
  Blueprint blueprint;
  for (const char* name : {"A", "B", "C", "D"}) {
    Activity activity = Activity::periodic(10ms);
    activity.thread = name < std::string("C") ? "first" : "second";
    blueprint.add<Probe>(name, activity).journal = &journal;
  }
  blueprint.connect("A.Out", "C.Look");
  blueprint.connect("C.Out", "B.Look");
  blueprint.connect("B.Out", "D.Look");
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(application.stop().ok());
  std::vector<std::string> stops = journal.take();
  std::erase_if(stops, [](const std::string& entry) { return !entry.ends_with("stop"); });
  EXPECT_THAT(stops, ElementsAre("D stop", "B stop", "C stop", "A stop"));
}

TEST_P(ApplicationTime, StartingTwiceOrStoppingTwiceDoesNothing) {
  Chain chain;
  Application application(std::move(chain.blueprint), options());
  ASSERT_TRUE(application.start().ok());
  chain.life();
  EXPECT_TRUE(application.start().empty());
  EXPECT_THAT(chain.life(), IsEmpty());
  EXPECT_TRUE(application.stop().ok());
  chain.life();
  EXPECT_TRUE(application.stop().empty());
  EXPECT_THAT(chain.life(), IsEmpty());
}

TEST_P(ApplicationTime, ItsDestructorStopsEverything) {
  Chain chain;
  {
    Application application(std::move(chain.blueprint), options());
    ASSERT_TRUE(application.start().ok());
    chain.life();
  }
  EXPECT_THAT(chain.life(),
              ElementsAre("C stop", "B stop", "A stop", "C cleanup", "B cleanup", "A cleanup"));
}

TEST_P(ApplicationTime, RunsAgainAfterAStop) {
  Blueprint blueprint;
  blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  Sink& sink = blueprint.add<Sink>("Sink");
  Gain& gain = blueprint.add<Gain>("Gain", Activity::triggered());
  blueprint.add_peer("Sink", "Counter");
  blueprint.connect("Counter.Count", "Gain.In");
  blueprint.connect("Gain.Out", "Sink.In");
  Application application(std::move(blueprint), options());
  for (int round = 1; round <= 3; ++round) {
    ASSERT_TRUE(application.start().ok());
    const int ticks = sink.ticks;
    const int steps = gain.steps;
    EXPECT_TRUE(
        run_until(application, [&] { return sink.ticks >= ticks + 5 && gain.steps >= steps + 5; }));
    EXPECT_TRUE(application.stop().ok());
  }
}

TEST_P(ApplicationTime, RefusesWhatItsCheckRefusesAndTouchesNothing) {
  Chain chain;
  chain.blueprint.connect("A.Out", "C.Nothing");
  Application application(std::move(chain.blueprint), options());
  EXPECT_EQ(application.start().to_text(),
            "error: 'C' has no input port 'Nothing' (known: In, Look)\n");
  EXPECT_FALSE(application.running());
  EXPECT_THAT(chain.life(), IsEmpty());
}

// --- refusals and faults on the way up -----------------------------------------------------------

TEST_P(ApplicationTime, ARefusalToConfigureLeavesNothingHalfDone) {
  Chain chain;
  chain.b->refusals["configure"] = "no card answers";
  Application application(std::move(chain.blueprint), options());
  EXPECT_EQ(application.start().to_text(), "error: 'B' refuses to configure: no card answers\n");
  EXPECT_FALSE(application.running());
  EXPECT_THAT(chain.life(),
              ElementsAre("A configure", "B configure", "C configure", "C cleanup", "A cleanup"));
  EXPECT_THAT(chain.states(),
              ElementsAre(State::kPreOperational, State::kPreOperational, State::kPreOperational));
  chain.b->refusals.clear();
  EXPECT_TRUE(application.start().ok()) << "it can be started again";
}

TEST_P(ApplicationTime, EveryRefusalToConfigureIsTold) {
  Chain chain;
  chain.a->refusals["configure"] = "no bus";
  chain.c->throw_in("configure");
  Application application(std::move(chain.blueprint), options());
  EXPECT_EQ(application.start().to_text(),
            "error: 'A' refuses to configure: no bus\n"
            "error: 'C' refuses to configure: exception: thrown in configure\n");
}

TEST_P(ApplicationTime, ARefusalToActivateComesBeforeAnybodyStarts) {
  Chain chain;
  chain.b->refusals["activate"] = "not today";
  Application application(std::move(chain.blueprint), options());
  EXPECT_EQ(application.start().to_text(), "error: 'B' refuses to start: not today\n");
  EXPECT_THAT(chain.life(), ElementsAre("A configure", "B configure", "C configure", "A activate",
                                        "B activate", "C cleanup", "B cleanup", "A cleanup"));
  chain.b->refusals.clear();
  EXPECT_TRUE(application.start().ok());
}

TEST_P(ApplicationTime, ARefusalToStartStopsWhatHadStartedInReverse) {
  Chain chain;
  chain.c->refusals["start"] = "not today";
  Application application(std::move(chain.blueprint), options());
  EXPECT_EQ(application.start().to_text(), "error: 'C' refuses to start: not today\n");
  EXPECT_THAT(chain.life(), ElementsAre("A configure", "B configure", "C configure", "A activate",
                                        "B activate", "C activate", "A start", "B start", "C start",
                                        "B stop", "A stop", "C cleanup", "B cleanup", "A cleanup"));
  EXPECT_THAT(chain.states(),
              ElementsAre(State::kPreOperational, State::kPreOperational, State::kPreOperational));
  chain.c->refusals.clear();
  EXPECT_TRUE(application.start().ok());
}

TEST_P(ApplicationTime, AnExceptionOnTheWayUpIsARefusalAndItCanBeStartedAgain) {
  for (const char* hook : {"configure", "activate", "start"}) {
    Chain chain;
    chain.b->throw_in(hook);
    Application application(std::move(chain.blueprint), options());
    const std::string verb = hook == std::string("configure") ? "configure" : "start";
    EXPECT_EQ(application.start().to_text(),
              "error: 'B' refuses to " + verb + ": exception: thrown in " + hook + "\n");
    EXPECT_THAT(chain.states(), ElementsAre(State::kPreOperational, State::kPreOperational,
                                            State::kPreOperational));
    ASSERT_EQ(application.casualties().size(), 1u);
    EXPECT_EQ(application.casualties()[0].component, "B");
    EXPECT_EQ(application.casualties()[0].state, State::kException);
    EXPECT_EQ(application.casualties()[0].reason, std::string("exception: thrown in ") + hook);
    chain.b->actions.erase(hook);
    EXPECT_EQ(application.start().to_text(), "") << hook;
  }
}

TEST_P(ApplicationTime, AFaultThatOthersCauseOnTheWayUpIsToldToo) {
  Chain chain;
  chain.b->actions["start"] = [&] {
    chain.a->fault("pushed");
    chain.c->fault("pushed too");
  };
  Application application(std::move(chain.blueprint), options());
  EXPECT_EQ(application.start().to_text(),
            "error: 'C' refuses to start: cannot start while Exception: pushed too\n");
  chain.c->actions["start"] = [&] { chain.a->fault("pushed"); };
  chain.b->actions.erase("start");
  EXPECT_EQ(application.start().to_text(), "error: 'A' faulted while others started: pushed\n");
  chain.c->actions.erase("start");
  EXPECT_EQ(application.start().to_text(), "");
}

TEST_P(ApplicationTime, SizesThatDoNotFitAfterConfiguringAreFoundBeforeTheStart) {
  class Source final : public component::Component {
   public:
    using Component::Component;
    component::OutputPort<std::vector<double>> out{this, "Out", "values"};

   private:
    component::Outcome on_configure() override {
      out.set_sample({1.0, 2.0, 3.0});
      return component::accepted();
    }
  };
  class Target final : public component::Component {
   public:
    using Component::Component;
    component::InputPort<std::vector<double>> in{this, "In", "values", "",
                                                 component::fixed_size(2)};
  };
  Blueprint blueprint;
  blueprint.add<Source>("Source");
  blueprint.add<Target>("Target");
  blueprint.connect("Source.Out", "Target.In");
  blueprint.connections[0].where = {"robot.yaml", 8, 5};
  Application application(std::move(blueprint), options());
  EXPECT_EQ(application.start().to_text(),
            "robot.yaml:8:5: error: 'Source.Out' was configured with another number of elements "
            "than 'Target.In' expects\n");
}

TEST_P(ApplicationTime, WhoDoesNotStartByItselfIsStartedLater) {
  Chain chain;
  chain.blueprint.components[0].autostart = false;
  chain.blueprint.components[1].autostart = false;
  chain.blueprint.components[1].autoconfigure = false;
  Application application(std::move(chain.blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_THAT(chain.states(),
              ElementsAre(State::kRunning, State::kPreOperational, State::kStopped));
  chain.life();
  EXPECT_TRUE(application.start_component("C"));
  EXPECT_TRUE(application.start_component("B"));
  EXPECT_THAT(chain.life(),
              ElementsAre("C activate", "C start", "B configure", "B activate", "B start"));
  EXPECT_TRUE(application.stop().ok());
  EXPECT_THAT(chain.life(),
              ElementsAre("C stop", "B stop", "A stop", "C cleanup", "B cleanup", "A cleanup"));
}

// --- faults while it runs ------------------------------------------------------------------------

TEST_P(ApplicationTime, AnExceptionFaultsItsComponentAndWhatReadsItStops) {
  Blueprint blueprint;
  Counter& counter = blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  Gain& gain = blueprint.add<Gain>("Gain");
  Sink& sink = blueprint.add<Sink>("Sink");
  gain.throw_at = 3;
  blueprint.connect("Counter.Count", "Gain.In");
  blueprint.connect("Gain.Out", "Sink.In");
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return sink.state() != State::kRunning; }));
  application.run_for(3ms);
  EXPECT_EQ(gain.state(), State::kException);
  EXPECT_EQ(counter.state(), State::kRunning) << "the writer goes on";
  EXPECT_EQ(application.faults(), 1u);
  EXPECT_EQ(application.reactions(), 1u);
  EXPECT_EQ(gain.steps, 3);
  EXPECT_TRUE(application.stop().ok());
  ASSERT_EQ(application.casualties().size(), 2u);
  EXPECT_EQ(application.casualties()[0].component, "Gain");
  EXPECT_EQ(application.casualties()[0].state, State::kException);
  EXPECT_EQ(application.casualties()[0].reason, "exception: broken tooth");
  EXPECT_EQ(application.casualties()[1].component, "Sink");
  EXPECT_EQ(application.casualties()[1].state, State::kStopped);
  EXPECT_EQ(application.casualties()[1].reason,
            "input 'In': the component that writes it is out of service");
  gain.throw_at = 0;
  EXPECT_EQ(application.start().to_text(), "") << "a fault does not outlive the application";
}

TEST_P(ApplicationTime, AnExceptionInAnyHookOrHandlerStaysWithItsComponent) {
  for (const char* hook : {"update", "in", "error"}) {
    Blueprint blueprint;
    blueprint.add<Probe>("Other", Activity::periodic(1ms));
    Probe& writer = blueprint.add<Probe>("Writer", Activity::periodic(1ms));
    Probe& probe = blueprint.add<Probe>("Probe", Activity::periodic(1ms));
    blueprint.connect("Writer.Out", "Probe.In");
    writer.actions["update"] = [&] { writer.out.write(1.0); };
    if (hook == std::string("error")) probe.actions["update"] = [&] { probe.error("odd"); };
    probe.throw_in(hook);
    Application application(std::move(blueprint), options());
    ASSERT_TRUE(application.start().ok());
    EXPECT_TRUE(run_until(application, [&] { return probe.state() == State::kException; }));
    EXPECT_EQ(application.find("Other")->state(), State::kRunning);
    EXPECT_EQ(writer.state(), State::kRunning);
    EXPECT_TRUE(application.stop().ok());
    EXPECT_EQ(application.casualties().at(0).reason, std::string("exception: thrown in ") + hook);
  }
}

TEST_P(ApplicationTime, AnExceptionWhileStoppingDoesNotKeepTheOthersFromStopping) {
  Chain chain;
  chain.b->throw_in("stop");
  Application application(std::move(chain.blueprint), options());
  ASSERT_TRUE(application.start().ok());
  chain.life();
  EXPECT_EQ(application.stop().to_text(), "");
  EXPECT_THAT(chain.life(),
              ElementsAre("C stop", "B stop", "A stop", "C cleanup", "B cleanup", "A cleanup"));
  EXPECT_EQ(application.faults(), 1u);
  ASSERT_EQ(application.casualties().size(), 1u);
  EXPECT_EQ(application.casualties()[0].reason, "exception: thrown in stop");
}

TEST_P(ApplicationTime, AnExceptionInACleanupIsToldAndTheOthersCleanUp) {
  Chain chain;
  chain.b->throw_in("cleanup");
  Application application(std::move(chain.blueprint), options());
  ASSERT_TRUE(application.start().ok());
  chain.life();
  EXPECT_EQ(application.stop().to_text(),
            "error: 'B' faulted while it was cleaned up: exception: thrown in cleanup\n");
  EXPECT_THAT(chain.life(),
              ElementsAre("C stop", "B stop", "A stop", "C cleanup", "B cleanup", "A cleanup"));
}

TEST_P(ApplicationTime, OneWithAFaultIsResetAndStartsWhileTheOthersRun) {
  Chain chain;
  Application application(std::move(chain.blueprint), options());
  chain.b->throw_in("update");
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return chain.b->state() == State::kException; }));
  EXPECT_FALSE(application.start_component("B")) << "not without a reset";
  ASSERT_TRUE(application.run_in_thread_of(*chain.b, [&] { chain.b->actions.erase("update"); }));
  EXPECT_TRUE(application.reset_component("B"));
  EXPECT_EQ(chain.b->state(), State::kStopped);
  EXPECT_TRUE(application.start_component("B"));
  EXPECT_EQ(chain.b->state(), State::kRunning);
  EXPECT_EQ(chain.a->state(), State::kRunning);
  EXPECT_TRUE(application.stop().ok());
  EXPECT_THAT(application.casualties().size(), 1u) << "C, which reads B, had stopped";
}

TEST_P(ApplicationTime, AnErrorRunsTheErrorHookUntilItRecovers) {
  Chain chain;
  chain.c->actions["update"] = [&] { chain.c->error("odd value"); };
  Application application(std::move(chain.blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return chain.c->state() == State::kRunTimeError; }));
  ASSERT_TRUE(application.run_in_thread_of(*chain.c, [&] { chain.c->actions["update"] = [] {}; }));
  EXPECT_TRUE(application.recover_component("C"));
  EXPECT_EQ(chain.c->state(), State::kRunning);
  EXPECT_FALSE(application.recover_component("C"));
}

// --- the end of a run ----------------------------------------------------------------------------

TEST_P(ApplicationTime, ARunEndsWhenItsTimeIsUp) {
  Chain chain;
  Application application(std::move(chain.blueprint), options());
  ASSERT_TRUE(application.start().ok());
  const base::Time begin = application.now();
  EXPECT_EQ(application.run_for(15ms), RunEnd::kTimeUp);
  EXPECT_GE(application.now() - begin, 15ms);
}

TEST_P(ApplicationTime, AFaultEndsTheRunIfThatIsDeclaredAndElseNot) {
  for (const OnFault on_fault : {OnFault::kStop, OnFault::kContinue}) {
    Chain chain;
    chain.c->throw_in("update");
    ApplicationOptions declared = options();
    declared.on_fault = on_fault;
    Application application(std::move(chain.blueprint), declared);
    ASSERT_TRUE(application.start().ok());
    if (on_fault == OnFault::kStop) {
      EXPECT_EQ(application.run_for(60s), RunEnd::kFaulted);
    } else {
      EXPECT_TRUE(run_until(application, [&] { return application.faults() > 0; }));
      EXPECT_EQ(application.run_for(15ms), RunEnd::kTimeUp);
    }
  }
}

TEST_P(ApplicationTime, ADeclaredReactionEndsTheRunLikeAFault) {
  Blueprint blueprint;
  Probe& writer = blueprint.add<Probe>("Writer", Activity::periodic(1ms));
  Probe& reader = blueprint.add<Probe>("Reader", Activity::periodic(1ms));
  blueprint.connect("Writer.Out", "Reader.Look");
  blueprint.connections[0].max_age = component::max_age(3ms);
  writer.actions["start"] = [&] { writer.out.write(1.0); };
  ApplicationOptions declared = options();
  declared.on_fault = OnFault::kStop;
  Application application(std::move(blueprint), declared);
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.run_for(60s), RunEnd::kStoppedByReaction);
  EXPECT_EQ(reader.state(), State::kStopped);
  EXPECT_EQ(application.faults(), 0u);
}

TEST_P(ApplicationTime, AStopSignalEndsTheRun) {
  Chain chain;
  Application application(std::move(chain.blueprint), options());
  ASSERT_TRUE(application.start().ok());
  {
    const platform::StopSignal stop;
    EXPECT_EQ(application.run_for(15ms, &stop), RunEnd::kTimeUp);
    std::raise(SIGTERM);
    EXPECT_EQ(application.run_for(std::chrono::hours(24 * 365), &stop), RunEnd::kStopRequested);
  }
  EXPECT_TRUE(application.stop().ok());
}

// --- cycles --------------------------------------------------------------------------------------

TEST_P(ApplicationTime, EveryPeriodIsACycleRunOrACycleSkipped) {
  Blueprint blueprint;
  blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  const base::Time begin = application.now();
  application.run_for(200ms);
  const base::Time end = application.now();
  EXPECT_TRUE(application.stop().ok());
  const ThreadStatistics statistics = application.thread_statistics().front();
  EXPECT_EQ(statistics.name, "Counter");
  const std::uint64_t cycles = statistics.cycles_run + statistics.cycles_skipped;
  EXPECT_GE(cycles, static_cast<std::uint64_t>((end - begin) / 1ms) - 1);
  EXPECT_EQ(statistics.latency_ns.count, statistics.cycles_run);
  EXPECT_EQ(statistics.cycle_ticks.count, statistics.cycles_run);
  if (GetParam()) {
    EXPECT_EQ(cycles, 200u);
  }
}

TEST_P(ApplicationTime, ExecutionTimesAreTakenForEachComponentInTheCyclesAskedFor) {
  Blueprint blueprint;
  Counter& counter = blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  Gain& gain = blueprint.add<Gain>("Gain");
  Sink& sink = blueprint.add<Sink>("Sink");
  blueprint.connect("Counter.Count", "Gain.In");
  blueprint.connect("Gain.Out", "Sink.In");
  ApplicationOptions fourth = options();
  fourth.measure_every = 4;
  Application application(std::move(blueprint), fourth);
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(run_until(application, [&] { return gain.steps >= 100; }));
  EXPECT_TRUE(application.stop().ok());
  const std::uint64_t cycles = application.thread_statistics().front().cycles_run;
  EXPECT_EQ(counter.execution_ticks().summary().count, cycles / 4);
  EXPECT_EQ(gain.execution_ticks().summary().count, cycles / 4);
  EXPECT_EQ(sink.execution_ticks().summary().count, 0u) << "it only lies there";
}

TEST_P(ApplicationTime, AnApplicationWithoutComponentsRunsToo) {
  Application application(Blueprint{}, options());
  EXPECT_EQ(application.start().to_text(), "");
  EXPECT_EQ(application.run_for(1ms), RunEnd::kTimeUp);
  EXPECT_EQ(application.stop().to_text(), "");
}

}  // namespace
}  // namespace armature::exec
