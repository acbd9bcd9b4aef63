// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/application.hpp"

#include <algorithm>
#include <csignal>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/test_chain.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec {
namespace {

using component::State;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

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

TEST_P(ApplicationTime, WhatIsWrittenAtTheStartReachesATriggeredThreadWithoutAnotherWrite) {
  Journal journal;
  Blueprint blueprint;
  Probe& writer = blueprint.add<Probe>("Writer", Activity::triggered());
  Probe& reader = blueprint.add<Probe>("Reader", Activity::triggered());
  blueprint.connect("Writer.Out", "Reader.In");
  writer.actions["start"] = [&writer] { writer.out.write(1.0); };
  std::atomic<bool> seen{false};
  reader.actions["in"] = [&seen] { seen = true; };
  Application application(std::move(blueprint), options());
  ASSERT_EQ(application.start().to_text(), "");
  EXPECT_TRUE(run_until(application, [&] { return seen.load(); }));
  EXPECT_TRUE(application.stop().ok());
}

TEST_P(ApplicationTime, LimitsMayBeForEver) {
  Blueprint blueprint;
  Probe& probe = blueprint.add<Probe>("A", Activity::periodic(1ms));
  probe.actions["start"] = [] { platform::sleep_until(platform::monotonic_now() + 60ms); };
  probe.actions["update"] = [&probe] { probe.fault("enough"); };
  ApplicationOptions for_ever = options();
  for_ever.hook_limit = base::Duration::max();
  for_ever.stop_limit = base::Duration::max();
  for_ever.on_fault = OnFault::kStopAll;
  Application application(std::move(blueprint), for_ever);
  ASSERT_EQ(application.start().to_text(), "");
  EXPECT_EQ(application.run_for(base::Duration::max()), RunEnd::kFaulted);
  EXPECT_TRUE(application.stop().ok());
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
  for (const OnFault on_fault : {OnFault::kStopAll, OnFault::kStopDependents}) {
    Chain chain;
    chain.c->throw_in("update");
    ApplicationOptions declared = options();
    declared.on_fault = on_fault;
    Application application(std::move(chain.blueprint), declared);
    ASSERT_TRUE(application.start().ok());
    if (on_fault == OnFault::kStopAll) {
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
  declared.on_fault = OnFault::kStopAll;
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
  EXPECT_EQ(component::Host::execution_ticks(counter).summary().count, cycles / 4);
  EXPECT_EQ(component::Host::execution_ticks(gain).summary().count, cycles / 4);
  EXPECT_EQ(component::Host::execution_ticks(sink).summary().count, 0u) << "it only lies there";
}

TEST(Application, ExecutionTimesAreUsuallyTakenFourTimesASecond) {
  Blueprint blueprint;
  const Counter& fast = blueprint.add<Counter>("Fast", Activity::periodic(1ms));
  const Counter& slow = blueprint.add<Counter>("Slow", Activity::periodic(100ms));
  ApplicationOptions simulated;
  simulated.simulated = true;
  Application application(std::move(blueprint), simulated);
  ASSERT_TRUE(application.start().ok());
  application.run_for(10s);
  ASSERT_TRUE(application.stop().ok());
  EXPECT_EQ(component::Host::execution_ticks(fast).summary().count, 10'000u / 251);
  EXPECT_EQ(component::Host::execution_ticks(slow).summary().count, 100u / 3);
}

TEST_P(ApplicationTime, AnApplicationWithoutComponentsRunsToo) {
  Application application(Blueprint{}, options());
  EXPECT_EQ(application.start().to_text(), "");
  EXPECT_EQ(application.run_for(1ms), RunEnd::kTimeUp);
  EXPECT_EQ(application.stop().to_text(), "");
}

}  // namespace
}  // namespace armature::exec
