// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/application.hpp"

#include <algorithm>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_models.hpp"

namespace armature::exec {
namespace {

using namespace std::chrono_literals;
using component::State;
using test::Counter;
using test::Gain;
using test::Journal;
using test::Sink;
using test::Witness;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ApplicationOptions simulated() {
  ApplicationOptions options;
  options.simulated = true;
  return options;
}

/// Three witnesses A -> B -> C, each noting what happens to it.
struct Chain {
  Journal journal;
  Blueprint blueprint;
  Witness* a;
  Witness* b;
  Witness* c;

  Chain() {
    // Declared against the flow, which is what decides.
    c = &blueprint.add<Witness>("C", Activity::periodic(10ms));
    b = &blueprint.add<Witness>("B", Activity::periodic(10ms));
    a = &blueprint.add<Witness>("A", Activity::periodic(10ms));
    for (Witness* each : {a, b, c}) each->journal = &journal;
    blueprint.connect("A.Out", "B.In");
    blueprint.connect("B.Out", "C.In");
  }
};

class ApplicationTime : public ::testing::TestWithParam<bool> {
 protected:
  static ApplicationOptions options() {
    ApplicationOptions options;
    options.simulated = GetParam();
    options.hook_limit = 60s;
    options.stop_limit = 60s;
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(SimulatedAndReal, ApplicationTime, ::testing::Bool());

TEST_P(ApplicationTime, StartsInTheOrderOfTheFlowAndStopsInReverse) {
  Chain chain;
  Application application(std::move(chain.blueprint), options());
  ASSERT_TRUE(application.start().ok());
  EXPECT_TRUE(application.stop().ok());
  EXPECT_THAT(chain.journal,
              ElementsAre("A configure", "B configure", "C configure", "A activate", "B activate",
                          "C activate", "A start", "B start", "C start", "C stop", "B stop",
                          "A stop", "C cleanup", "B cleanup", "A cleanup"));
}

TEST_P(ApplicationTime, ARefusalToStartUndoesEverythingAndNamesTheReason) {
  Chain chain;
  chain.b->refuse_in = "start";
  Application application(std::move(chain.blueprint), options());
  const base::Diagnostics diagnostics = application.start();
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("'B' refuses to start: not today"));
  EXPECT_FALSE(application.running());
  EXPECT_EQ(chain.a->state(), State::kPreOperational);
  EXPECT_EQ(chain.b->state(), State::kPreOperational);
  EXPECT_EQ(chain.c->state(), State::kPreOperational);
  EXPECT_EQ(std::count(chain.journal.begin(), chain.journal.end(), "C start"), 0);
  EXPECT_EQ(std::count(chain.journal.begin(), chain.journal.end(), "A stop"), 1);
  chain.b->refuse_in.clear();
  EXPECT_TRUE(application.start().ok()) << "nothing half done: it can be started again";
}

TEST_P(ApplicationTime, EveryRefusalToConfigureIsTold) {
  Chain chain;
  chain.a->refuse_in = "configure";
  chain.c->throw_in = "configure";
  Application application(std::move(chain.blueprint), options());
  const std::string text = application.start().to_text();
  EXPECT_THAT(text, HasSubstr("'A' refuses to configure: not today"));
  EXPECT_THAT(text, HasSubstr("thrown in configure"));
  EXPECT_EQ(std::count(chain.journal.begin(), chain.journal.end(), "B start"), 0);
}

TEST_P(ApplicationTime, RunsAgainAfterAStop) {
  Blueprint blueprint;
  blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  Sink& sink = blueprint.add<Sink>("Sink");
  blueprint.add_peer("Sink", "Counter");
  blueprint.connect("Counter.Count", "Sink.In");
  Application application(std::move(blueprint), options());
  for (int round = 1; round <= 2; ++round) {
    ASSERT_TRUE(application.start().ok());
    while (sink.ticks < 5 * round) application.run_for(1ms);
    EXPECT_TRUE(application.stop().ok());
  }
}

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
  while (sink.state() == State::kRunning) application.run_for(1ms);
  application.run_for(3ms);
  EXPECT_EQ(gain.state(), State::kException);
  EXPECT_EQ(counter.state(), State::kRunning) << "the writer goes on";
  EXPECT_EQ(application.faults(), 1u);
  EXPECT_EQ(application.reactions(), 1u);
  EXPECT_EQ(gain.steps, 3);
  EXPECT_THAT(std::string(sink.reason()), HasSubstr("'In'"));
}

TEST_P(ApplicationTime, AFaultEndsTheRunIfThatIsDeclared) {
  Chain chain;
  chain.b->throw_in = "update";
  ApplicationOptions all_stop = options();
  all_stop.on_fault = OnFault::kStop;
  Application application(std::move(chain.blueprint), all_stop);
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.run_for(60s), RunEnd::kFaulted);
}

TEST_P(ApplicationTime, ToolsReadWriteAndCallWhileItRuns) {
  Blueprint blueprint;
  blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  Gain& gain = blueprint.add<Gain>("Gain", Activity::triggered());
  blueprint.connect("Counter.Count", "Gain.In");
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  while (gain.steps < 3) application.run_for(1ms);
  ASSERT_TRUE(application.set_property("Gain", "Factor", types::Value::of(-1.0)).ok());
  const auto called = application.call("Gain", "scale", {types::Value::of(7.0)});
  ASSERT_TRUE(called.ok()) << called.error();
  EXPECT_EQ(*called.value()->get_if<double>(), -7.0);
  const int before = gain.steps;
  while (gain.steps == before) application.run_for(1ms);
  const auto value = application.value_of("Gain", "Out");
  ASSERT_TRUE(value.ok()) << value.error();
  EXPECT_LT(*value.value().get_if<double>(), 0.0);
  EXPECT_THAT(application.call("Gain", "scale", {}).error(), HasSubstr("double(double)"));
  EXPECT_FALSE(application.value_of("Gain", "Nothing").ok());
}

TEST_P(ApplicationTime, OneComponentStopsAndStartsWhileTheOthersRun) {
  Blueprint blueprint;
  blueprint.add<Counter>("Counter", Activity::periodic(1ms));
  Gain& gain = blueprint.add<Gain>("Gain", Activity::triggered());
  blueprint.connect("Counter.Count", "Gain.In");
  Application application(std::move(blueprint), options());
  ASSERT_TRUE(application.start().ok());
  while (gain.steps < 3) application.run_for(1ms);
  EXPECT_TRUE(application.stop_component("Gain").ok());
  EXPECT_EQ(gain.state(), State::kStopped);
  const int stopped_at = gain.steps;
  application.run_for(5ms);
  EXPECT_EQ(gain.steps, stopped_at);
  EXPECT_TRUE(application.start_component("Gain").ok());
  while (gain.steps == stopped_at) application.run_for(1ms);
  EXPECT_FALSE(application.start_component("Nobody").ok());
}

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
  const std::uint64_t cycles = statistics.cycles_run + statistics.cycles_skipped;
  EXPECT_GE(cycles, static_cast<std::uint64_t>((end - begin) / 1ms) - 1);
  if (GetParam()) {
    EXPECT_EQ(cycles, 200u);
  }
}

TEST(Application, RefusesWhatItsCheckRefusesAndTouchesNothing) {
  Chain chain;
  chain.blueprint.connect("A.Out", "C.Nothing");
  Application application(std::move(chain.blueprint), simulated());
  EXPECT_FALSE(application.start().ok());
  EXPECT_THAT(chain.journal, IsEmpty());
}

TEST(Application, ItsDestructorStopsEverything) {
  Chain chain;
  {
    Application application(std::move(chain.blueprint), simulated());
    ASSERT_TRUE(application.start().ok());
  }
  EXPECT_EQ(chain.journal.back(), "A cleanup");
}

TEST(Application, AHookThatHangsIsNamedAndTheRestIsLeftAlone) {
  struct Hanging : Witness {
    using Witness::Witness;
    component::Outcome on_configure() override {
      while (!released) std::this_thread::yield();
      return component::accepted();
    }
    std::atomic<bool> released{false};
  };
  Blueprint blueprint;
  Hanging& hanging = blueprint.add<Hanging>("Stuck");
  ApplicationOptions options = simulated();
  options.hook_limit = 50ms;
  Application application(std::move(blueprint), options);
  EXPECT_THAT(application.start().to_text(), HasSubstr("'Stuck' hangs: on_configure"));
  EXPECT_TRUE(application.hangs());
  hanging.released = true;
}

TEST(Application, AThreadThatHangsIsNamedWithItsComponentAndTheOthersStop) {
  struct Hanging : Witness {
    using Witness::Witness;
    void on_update() override {
      entered = true;
      while (!released) std::this_thread::yield();
    }
    std::atomic<bool> entered{false};
    std::atomic<bool> released{false};
  };
  Journal journal;
  Blueprint blueprint;
  Witness& other = blueprint.add<Witness>("Other", Activity::periodic(1ms));
  other.journal = &journal;
  Hanging& hanging = blueprint.add<Hanging>("Stuck", Activity::periodic(1ms));
  ApplicationOptions options;
  options.stop_limit = 50ms;
  Application application(std::move(blueprint), options);
  ASSERT_TRUE(application.start().ok());
  while (!hanging.entered) application.run_for(1ms);
  const std::string text = application.stop().to_text();
  EXPECT_THAT(text, HasSubstr("'Stuck' did not stop"));
  EXPECT_THAT(text, HasSubstr("hangs in 'Stuck'"));
  EXPECT_TRUE(application.hangs());
  EXPECT_EQ(std::count(journal.begin(), journal.end(), "Other stop"), 1);
  hanging.released = true;
}

/// Everything that a run of a threaded application shows: who ran when with what.
class Recorder : public test::Component {
 public:
  using Component::Component;
  component::InputPort<double> a{this, "A", "value", "rad", component::on_data<&Recorder::on_a>};
  component::InputPort<double> b{this, "B", "value", "rad"};
  std::string trace;

 private:
  void on_a(double value) {
    const auto other = b.read();
    trace += std::to_string(base::to_ns(time())) + " " + std::to_string(value) + " " +
             std::to_string(other.value) + std::string(name_of(other.status)) + "\n";
  }
};

std::string simulated_trace() {
  Blueprint blueprint;
  blueprint.add<Counter>("Fast", Activity::periodic(1ms, 50));
  blueprint.add<Counter>("Slow", Activity::periodic(7ms, 60));
  blueprint.add<Gain>("Gain", Activity::triggered(40));
  Recorder& recorder = blueprint.add<Recorder>("Recorder", Activity::triggered(30));
  blueprint.connect("Fast.Count", "Gain.In");
  blueprint.connect("Gain.Out", "Recorder.A",
                    {component::ConnectionPolicy::Kind::kFifo, 4, rt::WhenFull::kRefuse, false});
  blueprint.connect("Slow.Count", "Recorder.B");
  Application application(std::move(blueprint), simulated());
  EXPECT_TRUE(application.start().ok());
  application.run_for(2s);
  EXPECT_TRUE(application.stop().ok());
  return recorder.trace;
}

TEST(SimulatedApplication, TwoRunsAreEqualToTheLastBit) {
  const std::string first = simulated_trace();
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 2000);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(simulated_trace(), first);
}

TEST(SimulatedApplication, AtOneTimeTheMoreUrgentRunsFirst) {
  // Slow is more urgent than Fast, so at 7 ms its new count is there before Fast's chain runs.
  EXPECT_THAT(simulated_trace(), HasSubstr("7000000 14.000000 1.000000new"));
}

}  // namespace
}  // namespace armature::exec
