// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using component::ConnectionPolicy;
using testing::ElementsAre;

class Caller final : public component::Component {
 public:
  using Component::Component;
  component::OperationCaller<void()> ring{this, "ring", "calls a peer"};
};

class Bell final : public component::Component {
 public:
  using Component::Component;
  component::Operation<void()> ring{this, "ring", component::serve<&Bell::do_ring>, "rings"};

 private:
  void do_ring() {}
};

class Raiser final : public component::Component {
 public:
  using Component::Component;
  component::Event<> tick{this, "tick", "time passes"};
};

class Hearer final : public component::Component {
 public:
  using Component::Component;
  component::EventHandler<> tick{this, "tick", component::serve<&Hearer::on_tick>, "time passes"};
  component::InputPort<double> in{this,
                                  "In",
                                  "runs a handler",
                                  "",
                                  component::on_data<&Hearer::on_tick>,
                                  component::may_stay_open};
  component::InputPort<double> look{this, "Look", "is only read", "", component::may_stay_open};
  component::OutputPort<double> out{this, "Out", "a value"};

 private:
  void on_tick() {}
};

Plan plan_of(const Blueprint& blueprint) {
  base::Diagnostics diagnostics;
  Plan plan = make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  return plan;
}

std::string thread_of(const Blueprint& blueprint, const std::string& component) {
  const Plan plan = plan_of(blueprint);
  for (Index i = 0; i < blueprint.components.size(); ++i) {
    if (blueprint.components[i].component->name() == component) {
      return plan.threads[plan.thread_of[i]].name;
    }
  }
  return "no such component";
}

std::vector<std::string> names(const Blueprint& blueprint, const std::vector<Index>& indices) {
  std::vector<std::string> names;
  for (const Index index : indices) names.push_back(blueprint.components[index].component->name());
  return names;
}

// --- shared threads ------------------------------------------------------------------------------

Activity shared(const char* thread, base::Duration period = 1ms) {
  Activity activity = Activity::periodic(period);
  activity.thread = thread;
  return activity;
}

TEST(PlanSharedThreads, HaveOneThreadAndTheSumOfTheBudgets) {
  Blueprint blueprint;
  Activity activity = shared("loop");
  activity.budget = 100us;
  blueprint.add<Probe>("A", activity);
  blueprint.add<Probe>("B", activity);
  const Plan plan = plan_of(blueprint);
  ASSERT_EQ(plan.threads.size(), 2u) << "and the one for what nobody triggers";
  EXPECT_EQ(plan.threads[0].name, "loop");
  EXPECT_EQ(plan.threads[0].activity.budget, 200us);
  EXPECT_EQ(plan.threads[1].name, "service");
}

TEST(PlanSharedThreads, MustAgreeAndTheMessageSaysInWhatTheyDoNot) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", shared("loop"));
  Activity other = Activity::triggered(20);
  other.thread = "loop";
  other.cpus = {1};
  other.overrun = Overrun::kFault;
  blueprint.add<Probe>("B", other);
  blueprint.components[1].where = {"robot.yaml", 5, 3};
  blueprint.add<Probe>("C", shared("loop", 2ms));
  blueprint.components[2].where = {"robot.yaml", 6, 3};
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:5:3: error: 'B' and 'A' share the thread 'loop', but differ in kind, "
            "period, scheduler, priority, CPUs, overrun (give both the same, or each its own "
            "thread)\n"
            "robot.yaml:6:3: error: 'C' and 'A' share the thread 'loop', but differ in period "
            "(give both the same, or each its own thread)\n");
}

TEST(PlanSharedThreads, AreNotNamedLikeAComponentWithAThreadOfItsOwn) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", shared("B"));
  blueprint.add<Probe>("B", Activity::periodic(1ms));
  EXPECT_EQ(problems_of(blueprint),
            "error: the thread 'B' of 'A' has the name of a component that has its own thread "
            "(give the shared thread another name)\n");
}

TEST(PlanSharedThreads, UpdateWritersBeforeReaders) {
  Blueprint blueprint;
  for (const char* name : {"C", "B", "A", "Free"}) blueprint.add<Probe>(name, shared("loop"));
  blueprint.connect("A.Out", "B.Look");
  blueprint.connect("B.Out", "C.Look");
  const Plan plan = plan_of(blueprint);
  EXPECT_THAT(names(blueprint, plan.threads[0].updating), ElementsAre("A", "B", "C", "Free"));
  EXPECT_THAT(names(blueprint, plan.start_order), ElementsAre("A", "B", "C", "Free"));
}

Blueprint loop_of_three() {
  Blueprint blueprint;
  for (const char* name : {"In", "A", "B", "C"}) blueprint.add<Probe>(name, shared("loop"));
  blueprint.connect("A.Out", "B.Look");
  blueprint.connect("B.Out", "C.Look");
  blueprint.connect("C.Out", "A.Look");
  blueprint.connect("In.Out", "A.In");
  for (int i = 0; i < 4; ++i) {
    blueprint.connections[static_cast<std::size_t>(i)].where = {"robot.yaml", 20 + i, 5};
  }
  return blueprint;
}

TEST(PlanSharedThreads, ALoopIsAMistakeAtOneOfItsConnections) {
  const Blueprint blueprint = loop_of_three();
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:22:5: error: components that share the thread 'loop' read each other's "
            "data in a loop, so that no order has every writer before its reader: A -> B -> C -> A "
            "(declare on one connection of the loop: delay: one_cycle)\n");
}

TEST(PlanSharedThreads, ADelayOnAnyConnectionOpensTheLoopThere) {
  const std::vector<std::vector<std::string>> orders{
      {"In", "B", "C", "A"}, {"In", "C", "A", "B"}, {"In", "A", "B", "C"}};
  for (std::size_t delayed = 0; delayed < 3; ++delayed) {
    Blueprint blueprint = loop_of_three();
    blueprint.connections[delayed].policy.one_cycle_delay = true;
    EXPECT_EQ(names(blueprint, plan_of(blueprint).threads[0].updating), orders[delayed]);
  }
}

// --- the thread of a sequential component --------------------------------------------------------

TEST(PlanHosts, AComponentRunsInTheMostUrgentThreadThatTriggersIt) {
  Blueprint blueprint;
  blueprint.add<Probe>("Slow", Activity::triggered(10));
  blueprint.add<Probe>("Urgent", Activity::triggered(80));
  auto& guest = blueprint.add<Hearer>("Guest");
  blueprint.components.back().peers.push_back({"Clock", {}});
  blueprint.add<Raiser>("Clock", Activity::triggered(40));
  blueprint.connect("Slow.Out", "Guest.In");
  EXPECT_FALSE(guest.in.connected());
  EXPECT_EQ(thread_of(blueprint, "Guest"), "Clock");
  blueprint.connections.clear();
  blueprint.connect("Urgent.Out", "Guest.In");
  EXPECT_EQ(thread_of(blueprint, "Guest"), "Urgent");
}

TEST(PlanHosts, ADeadlineThreadIsTheMostUrgentAndAnOrdinaryOneTheLeast) {
  Blueprint blueprint;
  blueprint.add<Probe>("Ordinary", Activity::periodic(1ms));
  blueprint.add<Probe>("Urgent", Activity::periodic(1ms, 99));
  Activity deadline = Activity::periodic(1ms);
  deadline.scheduler = Activity::Scheduler::kDeadline;
  deadline.budget = 100us;
  blueprint.add<Probe>("Deadline", deadline);

  class Joined final : public component::Component {
   public:
    using Component::Component;
    component::InputPort<double> in{
        this, "In", "runs update", "", component::on_data_update, component::fan_in};
  };
  blueprint.add<Joined>("Guest");
  blueprint.connect("Ordinary.Out", "Guest.In");
  EXPECT_EQ(thread_of(blueprint, "Guest"), "Ordinary");
  blueprint.connect("Urgent.Out", "Guest.In");
  EXPECT_EQ(thread_of(blueprint, "Guest"), "Urgent");
  blueprint.connect("Deadline.Out", "Guest.In");
  EXPECT_EQ(thread_of(blueprint, "Guest"), "Deadline");
}

TEST(PlanHosts, TriggersAreFollowedThroughOtherGuests) {
  Blueprint blueprint;
  blueprint.add<Probe>("Last");
  blueprint.add<Probe>("Middle");
  blueprint.add<Probe>("First", Activity::periodic(1ms));
  blueprint.connect("First.Out", "Middle.In");
  blueprint.connect("Middle.Out", "Last.In");
  EXPECT_EQ(thread_of(blueprint, "Last"), "First");
  const Plan plan = plan_of(blueprint);
  EXPECT_THAT(names(blueprint, plan.threads[0].members), ElementsAre("First", "Middle", "Last"));
  EXPECT_THAT(names(blueprint, plan.threads[0].updating), ElementsAre("First"));
}

TEST(PlanHosts, DataThatIsOnlyReadTriggersNothing) {
  Blueprint blueprint;
  blueprint.add<Probe>("Writer", Activity::periodic(1ms));
  blueprint.add<Probe>("Guest");
  blueprint.connect("Writer.Out", "Guest.Look");
  EXPECT_EQ(thread_of(blueprint, "Guest"), "service");
}

TEST(PlanHosts, AComponentThatIsOnlyCalledRunsInTheMostUrgentThreadThatCallsIt) {
  Blueprint blueprint;
  blueprint.add<Bell>("Bell");
  blueprint.add<Caller>("Slow", Activity::triggered(10));
  blueprint.add<Caller>("Urgent", Activity::triggered(80));
  blueprint.add_peer("Slow", "Bell");
  blueprint.add_peer("Urgent", "Bell");
  EXPECT_EQ(thread_of(blueprint, "Bell"), "Urgent");
}

TEST(PlanHosts, ATriggerCountsMoreThanAnUrgentCall) {
  class TriggeredBell final : public component::Component {
   public:
    using Component::Component;
    component::Operation<void()> ring{this, "ring", component::serve<&TriggeredBell::do_ring>,
                                      "rings"};
    component::InputPort<double> in{this, "In", "rings too", "",
                                    component::on_data<&TriggeredBell::do_ring>};

   private:
    void do_ring() {}
  };
  Blueprint blueprint;
  blueprint.add<TriggeredBell>("Bell");
  blueprint.add<Probe>("Slow", Activity::triggered(10));
  blueprint.add<Caller>("Urgent", Activity::triggered(80));
  blueprint.connect("Slow.Out", "Bell.In");
  blueprint.add_peer("Urgent", "Bell");
  EXPECT_EQ(thread_of(blueprint, "Bell"), "Slow");
}

TEST(PlanHosts, WhomNobodyTriggersOrCallsRunsInTheServiceThread) {
  Blueprint blueprint;
  blueprint.add<Probe>("Alone");
  const Plan plan = plan_of(blueprint);
  EXPECT_EQ(plan.thread_of[0], plan.service_thread());
  EXPECT_EQ(plan.threads[plan.service_thread()].activity.kind, Activity::Kind::kTriggered);
}

// --- periods and orders --------------------------------------------------------------------------

TEST(PlanPeriods, ATriggeredThreadIsTriggeredAsOftenAsTheFastestThatReachesIt) {
  Blueprint blueprint;
  blueprint.add<Probe>("Slow", Activity::periodic(10ms));
  blueprint.add<Probe>("Fast", Activity::periodic(2ms));
  blueprint.add<Probe>("Guest");
  blueprint.add<Probe>("Triggered", Activity::triggered());
  blueprint.add<Probe>("Free", Activity::triggered());
  blueprint.connect("Slow.Out", "Triggered.In");
  EXPECT_EQ(plan_of(blueprint).threads[2].trigger_period, 10ms);
  blueprint.connections.clear();
  blueprint.connect("Fast.Out", "Guest.In");
  blueprint.connect("Guest.Out", "Triggered.In");
  const Plan plan = plan_of(blueprint);
  EXPECT_EQ(plan.threads[2].trigger_period, 2ms);
  EXPECT_EQ(plan.threads[3].trigger_period, 0ms) << "not known";
}

TEST(PlanOrder, ComponentsStartInTheOrderOfTheFlowAndElseOfDeclaration) {
  Blueprint blueprint;
  for (const char* name : {"D", "C", "B", "A"}) blueprint.add<Probe>(name);
  blueprint.connect("A.Out", "B.Look");
  blueprint.connect("B.Out", "C.In");
  EXPECT_THAT(names(blueprint, plan_of(blueprint).start_order), ElementsAre("D", "A", "B", "C"));
}

TEST(PlanOrder, AFeedbackLoopBetweenThreadsStartsWhereItWasDeclaredFirst) {
  Blueprint blueprint;
  blueprint.add<Probe>("Plant", Activity::periodic(1ms));
  blueprint.add<Probe>("Controller", Activity::periodic(1ms));
  blueprint.connect("Controller.Out", "Plant.Look");
  blueprint.connect("Plant.Out", "Controller.Look");
  EXPECT_THAT(names(blueprint, plan_of(blueprint).start_order), ElementsAre("Plant", "Controller"));
}

TEST(PlanOrder, WhoIsTriggeredByAnotherIsToldOfAnEventBeforeIt) {
  Blueprint blueprint;
  blueprint.add<Raiser>("Clock", Activity::periodic(1ms));
  for (const char* name : {"Joint1", "Joint2", "Sensor", "Display"}) {
    blueprint.add<Hearer>(name);
    blueprint.add_peer(name, "Clock");
  }
  blueprint.connect("Joint1.Out", "Sensor.In");
  blueprint.connect("Sensor.Out", "Display.Look");
  std::vector<std::string> told;
  const Plan plan = plan_of(blueprint);
  for (const SubscriptionPlan& each : plan.subscriptions) {
    told.push_back(each.handler->owner().name());
  }
  EXPECT_THAT(told, ElementsAre("Joint2", "Sensor", "Joint1", "Display"))
      << "Sensor knows of the tick when Joint1's data comes; Display reads what Sensor wrote";
}

TEST(PlanOrder, ALoopBeyondThemDoesNotChangeWhoIsToldFirst) {
  Blueprint blueprint;
  blueprint.add<Raiser>("Clock", Activity::periodic(1ms));
  for (const char* name : {"Joint", "Sensor"}) {
    blueprint.add<Hearer>(name);
    blueprint.add_peer(name, "Clock");
  }
  blueprint.add<Probe>("Controller");
  blueprint.add<Probe>("Pid");
  blueprint.connect("Joint.Out", "Sensor.In");
  blueprint.connect("Sensor.Out", "Controller.In");
  blueprint.connect("Controller.Out", "Pid.In");    // Pid before Controller
  blueprint.connect("Controller.Out", "Pid.Look");  // and after it
  const Plan plan = plan_of(blueprint);
  ASSERT_EQ(plan.subscriptions.size(), 2u);
  EXPECT_EQ(plan.subscriptions[0].handler->owner().name(), "Sensor");
  EXPECT_EQ(plan.subscriptions[1].handler->owner().name(), "Joint");
}

TEST(PlanOrder, IsDescribedForPeople) {
  Blueprint blueprint;
  blueprint.add<Raiser>("Clock", Activity::periodic(10ms, 80));
  blueprint.add<Hearer>("Guest");
  blueprint.add<Hearer>("Remote", Activity::triggered(79));
  blueprint.add<Probe>("Alone");
  blueprint.add_peer("Guest", "Clock");
  blueprint.add_peer("Remote", "Clock");
  EXPECT_EQ(describe_order(blueprint, plan_of(blueprint)),
            "thread Clock (periodic 10000 us, priority 80)\n"
            "  updates Clock\n"
            "  hosts Guest\n"
            "  Clock.tick is handled by Guest\n"
            "thread Remote (triggered, priority 79)\n"
            "  updates Remote\n"
            "  Clock.tick is handled by Remote, by message\n"
            "thread service (triggered)\n"
            "  hosts Alone\n");
}

}  // namespace
}  // namespace armature::exec
