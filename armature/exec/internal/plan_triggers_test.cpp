// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using namespace component;

/// Declares what its handlers write.
class Filter final : public Component {
 public:
  using Component::Component;
  InputPort<double> in{this,          "In",           "is filtered", "", on_data<&Filter::on_in>,
                       may_stay_open, leads_to("Out")};
  InputPort<double> tune{this,
                         "Tune",
                         "changes the filter",
                         "",
                         on_data<&Filter::on_in>,
                         may_stay_open,
                         leads_to_nothing()};
  OutputPort<double> out{this, "Out", "filtered"};
  OutputPort<double> state{this, "State", "of the filter"};

 private:
  void on_in() {}
};

class Asker final : public Component {
 public:
  using Component::Component;
  Event<> ask{this, "ask", "wants to know"};
  EventHandler<> answer{this, "answer", serve<&Asker::on_answer>, "knows"};

 private:
  void on_answer() {}
};

class Answerer final : public Component {
 public:
  using Component::Component;
  Event<> answer{this, "answer", "tells"};
  EventHandler<> ask{this, "ask", serve<&Answerer::on_ask>, "is asked"};

 private:
  void on_ask() {}
};

Blueprint ring() {
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::periodic(1ms));
  blueprint.add<Probe>("B");
  blueprint.connect("A.Out", "B.In");
  blueprint.connect("B.Out", "A.In");
  blueprint.connections[0].where = {"robot.yaml", 10, 5};
  blueprint.connections[1].where = {"robot.yaml", 11, 5};
  return blueprint;
}

constexpr const char* kHint =
    " (declare delay: one_cycle on one of these connections, or leads_to(...) where a handler does "
    "not write all outputs of its component)\n";
constexpr const char* kHintWithoutDelay =
    " (declare leads_to(...) where a handler does not write all outputs of its component)\n";

TEST(PlanTriggers, HandlersThatSetEachOtherOffAreRefusedWithTheWay) {
  EXPECT_EQ(problems_of(ring()),
            std::string("robot.yaml:10:5: error: handlers may set each other off without end: "
                        "B.In -> A.In -> B.In") +
                kHint);
}

TEST(PlanTriggers, AComponentThatTriggersItselfIsRefused) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::periodic(1ms));
  blueprint.connect("A.Out", "A.In");
  EXPECT_EQ(
      problems_of(blueprint),
      std::string("error: handlers may set each other off without end: A.In -> A.In") + kHint);
}

TEST(PlanTriggers, EventsCountLikePorts) {
  Blueprint blueprint;
  blueprint.add<Asker>("Asker", Activity::periodic(1ms));
  blueprint.add<Answerer>("Answerer");
  blueprint.add_peer("Asker", "Answerer");
  blueprint.add_peer("Answerer", "Asker");
  blueprint.components[1].peers.front().superior = true;
  EXPECT_EQ(problems_of(blueprint),
            std::string("error: handlers may set each other off without end: Answerer.ask -> "
                        "Asker.answer -> Answerer.ask") +
                kHintWithoutDelay);
}

TEST(PlanTriggers, BetweenThreadsNothingIsSetOffAtOnce) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::triggered());
  blueprint.add<Probe>("B", Activity::triggered());
  blueprint.connect("A.Out", "B.In");
  blueprint.connect("B.Out", "A.In");
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST(PlanTriggers, ADelayOfACycleEndsTheCycleInAPeriodicThread) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::periodic(1ms));
  blueprint.add<Probe>("B");
  blueprint.connect("A.Out", "B.In");
  blueprint.connect("B.Out", "A.In");
  EXPECT_NE(problems_of(blueprint), "");
  blueprint.connections[1].policy.one_cycle_delay = true;
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST(PlanTriggers, ButNotInATriggeredOneWhoseNextCycleFollowsAtOnce) {
  Blueprint blueprint;
  blueprint.add<Probe>("A", Activity::triggered());
  blueprint.add<Probe>("B");
  blueprint.connect("A.Out", "B.In");
  blueprint.connect("B.Out", "A.In");
  const std::string problem =
      std::string("error: handlers may set each other off without end: B.In -> A.In -> B.In") +
      kHintWithoutDelay;
  EXPECT_EQ(problems_of(blueprint), problem);
  blueprint.connections[1].policy.one_cycle_delay = true;
  EXPECT_EQ(problems_of(blueprint), problem);
}

TEST(PlanTriggers, WhatAHandlerDoesNotWriteItDoesNotSetOff) {
  Blueprint blueprint;
  blueprint.add<Filter>("Filter", Activity::periodic(1ms));
  blueprint.add<Probe>("B");
  blueprint.connect("Filter.State", "B.In");
  blueprint.connect("B.Out", "Filter.In");
  EXPECT_EQ(problems_of(blueprint), "") << "In leads to Out only";
  blueprint.connections.clear();
  blueprint.connect("Filter.Out", "B.In");
  blueprint.connect("B.Out", "Filter.Tune");
  EXPECT_EQ(problems_of(blueprint), "") << "Tune leads to nothing";
  blueprint.connections.clear();
  blueprint.connect("Filter.Out", "B.In");
  blueprint.connect("B.Out", "Filter.In");
  EXPECT_NE(problems_of(blueprint), "");
}

TEST(PlanTriggers, EachCycleIsReportedOnce) {
  Blueprint blueprint = ring();
  blueprint.add<Probe>("C", Activity::periodic(1ms));
  blueprint.connect("C.Out", "C.In");
  base::Diagnostics diagnostics;
  make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 2u) << diagnostics.to_text();
}

/// A chain of `count` handlers behind a periodic source.
Blueprint chain(int count) {
  Blueprint blueprint;
  blueprint.add<Probe>("P0", Activity::periodic(1ms));
  for (int i = 1; i <= count; ++i) {
    blueprint.add<Probe>("P" + std::to_string(i));
    blueprint.connect("P" + std::to_string(i - 1) + ".Out", "P" + std::to_string(i) + ".In");
  }
  return blueprint;
}

TEST(PlanTriggers, TheDepthOfAThreadIsItsLongestChain) {
  Blueprint blueprint = chain(10);
  for (const char* name : {"X", "Y"}) blueprint.add<Probe>(name);
  blueprint.connect("P0.Out", "X.In");
  blueprint.connect("X.Out", "Y.In");
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(plan.threads[0].depth, 11) << "the update and ten handlers";
  EXPECT_EQ(plan.threads[plan.service_thread()].depth, 1);
}

TEST(PlanTriggers, WaysThatMeetAgainCountOnce) {
  Blueprint blueprint;
  class Join final : public Component {
   public:
    using Component::Component;
    InputPort<double> in{this, "In", "joins", "", on_data<&Join::on_in>, fan_in};
    OutputPort<double> out{this, "Out", "a value"};

   private:
    void on_in() {}
  };
  blueprint.add<Probe>("Source", Activity::periodic(1ms));
  blueprint.add<Probe>("Short");
  blueprint.add<Probe>("Long1");
  blueprint.add<Probe>("Long2");
  blueprint.add<Join>("Join");
  blueprint.add<Probe>("End");
  blueprint.connect("Source.Out", "Short.In");
  blueprint.connect("Source.Out", "Long1.In");
  blueprint.connect("Long1.Out", "Long2.In");
  blueprint.connect("Short.Out", "Join.In");
  blueprint.connect("Long2.Out", "Join.In");
  blueprint.connect("Join.Out", "End.In");
  base::Diagnostics diagnostics;
  EXPECT_EQ(make_plan(blueprint, diagnostics).threads[0].depth, 5);
}

TEST(PlanTriggers, AChainThatNoStackCouldHoldIsRefused) {
  EXPECT_EQ(problems_of(chain(2000)), "");
  EXPECT_EQ(problems_of(chain(2001)),
            "error: in the thread 'P0' handlers set each other off in a chain of 2001; at most "
            "2000 may nest (give a component in the middle of the chain its own thread)\n");
}

}  // namespace
}  // namespace armature::exec
