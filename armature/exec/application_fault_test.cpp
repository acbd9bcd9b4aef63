// SPDX-License-Identifier: Apache-2.0
// What refuses or faults in an application, and what becomes of the rest.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/application.hpp"
#include "armature/exec/internal/test_chain.hpp"

namespace armature::exec {
namespace {

using component::State;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

INSTANTIATE_TEST_SUITE_P(InBothKindsOfTime, ApplicationTime, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Simulated" : "Real"; });

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

TEST_P(ApplicationTime, AnObjectionWhenAllIsReadyIsARefusal) {
  Chain chain;
  ApplicationOptions objecting = options();
  objecting.ready = [] { throw std::runtime_error("the door is open"); };
  Application application(std::move(chain.blueprint), objecting);
  EXPECT_EQ(application.start().to_text(), "error: not ready: the door is open\n");
  EXPECT_FALSE(application.running());
  EXPECT_THAT(chain.states(), Each(State::kPreOperational));
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

/// Gives up when it is asked to, by an operation that runs in its caller's thread.
class Quitter final : public component::Component {
 public:
  using Component::Component;
  component::Operation<void()> quit{this, "quit", component::serve<&Quitter::do_quit>, "faults"};

 private:
  void do_quit() { fault("asked to"); }
};

class Asker final : public component::Component {
 public:
  using Component::Component;
  component::OperationCaller<void()> quit{this, "quit", "makes the peer quit"};

 private:
  void on_update() override {
    if (!std::exchange(asked_, true)) quit();
  }
  bool asked_ = false;
};

TEST_P(ApplicationTime, AFaultInAnOperationOfTheCallersThreadIsTheComponentsOwn) {
  Blueprint blueprint;
  blueprint.add<Asker>("Asker", Activity::periodic(1ms));
  Quitter& quitter = blueprint.add<Quitter>("Quitter", Activity::triggered());
  blueprint.add_peer("Asker", "Quitter");
  Application application(std::move(blueprint), options());
  ASSERT_EQ(application.start().to_text(), "");
  EXPECT_TRUE(run_until(application, [&] { return application.faults() > 0; }));
  EXPECT_TRUE(application.stop().ok());
  EXPECT_EQ(quitter.reason(), "asked to");
}

}  // namespace
}  // namespace armature::exec
