// SPDX-License-Identifier: Apache-2.0
// What a shadow must not be able to do is refused.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/observing/observer.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using component::Component;
using ::testing::HasSubstr;

/// Data in, data out, and all other ways to have an effect.
class Controller final : public Component {
 public:
  using Component::Component;

 private:
  void control(double) {}
  void ring_now() {}
  component::InputPort<double> in_{this,
                                   "In",
                                   "measured",
                                   "",
                                   component::on_data<&Controller::control>,
                                   component::may_stay_open};
  component::OutputPort<double> out_{this, "Out", "commanded"};
  component::OperationCaller<void()> call_{this, "call", "calls a peer", component::optional};
  component::Event<> raised_{this, "raised", "an event"};
  component::EventHandler<> told_{this, "raised", component::serve<&Controller::ring_now>,
                                  "another one's event", component::optional};
};

class Served final : public Component {
 public:
  using Component::Component;

 private:
  void serve_call() {}
  component::Operation<void()> call_{this, "call", component::serve<&Served::serve_call>, "serves"};
};

/// Stands for a component of another process.
class Ghost final : public component::StandIn {
 public:
  using StandIn::StandIn;
  void pass_on(component::InputPortBase&, const void*) override {}
  component::CallStatus call(component::OperationBase&, const void* const*, void*) override {
    return {};
  }
  component::Outcome begin(component::CommandBase&, const void* const*) override {
    return component::accepted();
  }
  void cancel(component::CommandBase&) override {}
};

/// Sees all components, and may write to them.
class Watcher final : public Component, private component::Observer {
 public:
  explicit Watcher(std::string name) : Component(std::move(name)), Observer(this) {}

 private:
  std::vector<Objection> check_view(const std::vector<Component*>&) const override { return {}; }
  void observe(const component::Surroundings&) override {}
};

/// Holds up whoever raises the event.
class Interrupting final : public Component {
 public:
  using Component::Component;

 private:
  void ring_now() {}
  component::EventHandler<> told_{this, "raised", component::serve<&Interrupting::ring_now>,
                                  "another one's event", component::in_raisers_thread};
};

/// A driving controller between a source and a drive, and a shadow beside it.
class Shadows : public testing::Test {
 protected:
  Shadows() {
    blueprint.add<Controller>("Source", Activity::periodic(1ms, 50));
    blueprint.add<Controller>("Driving");
    blueprint.add<Controller>("Drive");
    blueprint.add<Controller>("Shadow", Activity::triggered());
    blueprint.add<Controller>("Comparison");
    blueprint.connect("Source.Out", "Driving.In");
    blueprint.connect("Driving.Out", "Drive.In");
    blueprint.connect("Source.Out", "Shadow.In");
    entry("Shadow").shadow = true;
    entry("Comparison").shadow = true;
  }
  ComponentEntry& entry(const std::string& name) {
    for (ComponentEntry& each : blueprint.components) {
      if (each.component->name() == name) return each;
    }
    throw std::out_of_range(name);
  }
  Blueprint blueprint;
};

TEST_F(Shadows, MayWriteToShadows) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST_F(Shadows, LiveInTheThreadsOfShadowsWhoeverElseTriggersThem) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  blueprint.add<Controller>("Second");
  entry("Second").shadow = true;
  blueprint.connect("Comparison.Out", "Second.In");
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(plan.threads[plan.thread_of[4]].name, "Shadow");
  EXPECT_EQ(plan.threads[plan.thread_of[5]].name, "Shadow");
}

TEST_F(Shadows, MayNotWriteToWhoDrives) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  blueprint.add<Controller>("Other");
  blueprint.connect("Comparison.Out", "Other.In");
  EXPECT_THAT(problems_of(blueprint),
              HasSubstr("the shadow 'Comparison' writes 'Other.In', which is not of a shadow"));
}

TEST_F(Shadows, TakeNothingByQueuesThatCanBeFull) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  component::ConnectionPolicy queue;
  queue.kind = component::ConnectionPolicy::Kind::kFifo;
  queue.capacity = 8;
  blueprint.connections[2].policy = queue;
  EXPECT_THAT(problems_of(blueprint),
              HasSubstr("the shadow 'Shadow' takes data of 'Source' by a queue"));
  blueprint.connections[2].policy = {};
  blueprint.connections[3].policy = queue;
  EXPECT_EQ(problems_of(blueprint), "") << "among shadows it is their own affair";
}

TEST_F(Shadows, MayNotCallWhoIsNone) {
  blueprint.add<Served>("Served");
  blueprint.add_peer("Shadow", "Served");
  EXPECT_THAT(problems_of(blueprint),
              HasSubstr("the shadow 'Shadow' calls 'Served.call', which is not of a shadow"));
  entry("Served").shadow = true;
  blueprint.connect("Shadow.Out", "Comparison.In");
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST_F(Shadows, AreNotCalledByWhoIsNone) {
  blueprint.add<Served>("Served");
  entry("Served").shadow = true;
  blueprint.add_peer("Driving", "Served");
  EXPECT_THAT(problems_of(blueprint),
              HasSubstr("'Driving' calls 'Served.call', which is of a shadow"));
}

TEST_F(Shadows, TellShadowsAloneOfTheirEvents) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  blueprint.add_peer("Comparison", "Shadow");
  blueprint.add_peer("Shadow", "Source");
  EXPECT_EQ(problems_of(blueprint), "") << "a shadow may be told of others' events";
  blueprint.add_peer("Drive", "Shadow");
  EXPECT_THAT(problems_of(blueprint),
              HasSubstr("'Drive' is told of the event 'Shadow.raised', which is of a shadow"));
}

TEST_F(Shadows, TakeNoTimeOfWhoIsNone) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  entry("Shadow").activity = Activity::triggered(50);
  EXPECT_THAT(problems_of(blueprint),
              HasSubstr("the shadow 'Shadow' is as urgent as the thread 'Source', or more"));
  entry("Shadow").activity = Activity::triggered(49);
  EXPECT_EQ(problems_of(blueprint), "");
  entry("Shadow").activity = Activity::periodic(1ms);
  entry("Shadow").activity.thread = "shared";
  blueprint.add<Controller>("Other", Activity::periodic(1ms));
  entry("Other").activity.thread = "shared";
  EXPECT_THAT(problems_of(blueprint), HasSubstr("would run in the thread 'shared' of 'Other'"));
}

TEST_F(Shadows, HandleNoEventInTheThreadOfWhoIsNone) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  blueprint.add<Interrupting>("Told", Activity::periodic(1ms, 10));
  entry("Told").shadow = true;
  blueprint.add_peer("Told", "Shadow");
  EXPECT_EQ(problems_of(blueprint), "") << "among shadows it is their own affair";
  entry("Told").peers.clear();
  blueprint.add_peer("Told", "Source");
  EXPECT_THAT(problems_of(blueprint),
              HasSubstr("the shadow 'Told' handles the event 'Source.raised' in the thread of"));
}

TEST_F(Shadows, StandForNobodyInAnotherProcess) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  blueprint.add<Ghost>("Ghost", Activity::periodic(1ms, 10));
  EXPECT_EQ(problems_of(blueprint), "");
  entry("Ghost").shadow = true;
  EXPECT_THAT(problems_of(blueprint),
              HasSubstr("'Ghost' is a shadow, but stands for a component of another process"));
}

TEST_F(Shadows, ReachNobodyWithoutAConnection) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  blueprint.add<Watcher>("Watcher", Activity::periodic(1ms, 10));
  EXPECT_EQ(problems_of(blueprint), "");
  entry("Watcher").shadow = true;
  EXPECT_THAT(
      problems_of(blueprint),
      HasSubstr("'Watcher' is a shadow, but reaches other components without a connection"));
}

TEST_F(Shadows, HaveNoSuperiors) {
  blueprint.connect("Shadow.Out", "Comparison.In");
  entry("Shadow").peers.push_back({"Source", {}, true});
  EXPECT_THAT(problems_of(blueprint), HasSubstr("has the superior 'Source'"));
}

}  // namespace
}  // namespace armature::exec
