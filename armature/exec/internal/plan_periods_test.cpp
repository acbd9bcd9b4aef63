// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

/// Offers an operation that does nothing.
class Served final : public component::Component {
 public:
  using Component::Component;
  component::Operation<void()> ask{this, "ask", component::serve<&Served::answer>, "nothing"};

 private:
  void answer() {}
};

/// Raises an event when somebody asks for it.
class Bell final : public component::Component {
 public:
  using Component::Component;
  component::Event<> rung{this, "Rung", "somebody rang", component::occasional};
};

/// Calls it.
class Asking final : public component::Component {
 public:
  using Component::Component;
  component::OperationCaller<void()> ask{this, "ask", "a peer"};
};

/// Handles what a counter tells, and does nothing.
struct Hearing {
  Hearing(component::Component& owner, const char* doc)
      : tick(
            &owner, "Tick", +[](void*, const std::int64_t&) {}, nullptr, doc) {}
  component::EventHandler<std::int64_t> tick;
};

class PlanPeriods : public ::testing::Test {
 protected:
  Counter& count_every(base::Duration period, const char* name = "Counter") {
    return blueprint.add<Counter>(name, Activity::periodic(period));
  }
  std::string problems() { return problems_of(blueprint); }

  Blueprint blueprint;
};

TEST_F(PlanPeriods, APeriodicComponentHasItsOwn) {
  const Counter& counter = count_every(2ms);
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(counter.period(), 2ms);
  EXPECT_EQ(counter.pace().owner, &counter);
}

TEST_F(PlanPeriods, WhoIsTriggeredHasThatOfWhoTriggersItThroughAnyChain) {
  const Counter& counter = count_every(2ms);
  const Gain& first = blueprint.add<Gain>("First");
  const Gain& second = blueprint.add<Gain>("Second", Activity::triggered());
  const Sink& told = blueprint.add<Sink>("Told");
  blueprint.connect("Counter.Count", "First.In");
  blueprint.connect("First.Out", "Second.In");
  blueprint.connect("Second.Out", "Told.In");
  blueprint.add_peer("Told", "Counter");
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(first.period(), 2ms);
  EXPECT_EQ(second.period(), 2ms);
  EXPECT_EQ(second.pace().owner, &counter);
  EXPECT_EQ(told.period(), 2ms);
}

TEST_F(PlanPeriods, WhoOnlyReadsHasNone) {
  count_every(2ms);
  const Sink& sink = blueprint.add<Sink>("Sink");
  blueprint.connect("Counter.Count", "Sink.In");
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(sink.period(), 0ms);
  EXPECT_FALSE(sink.pace().known());
  EXPECT_FALSE(sink.pace().ambiguous());
}

TEST_F(PlanPeriods, TheOwnOneCountsWhateverTriggersIt) {
  count_every(2ms);
  const Gain& gain = blueprint.add<Gain>("Gain", Activity::periodic(20ms));
  blueprint.connect("Counter.Count", "Gain.In");
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(gain.period(), 20ms);
}

TEST_F(PlanPeriods, TwoThatDifferAreKnownAsSuchAndSoIsWhatFollows) {
  const Counter& quick = count_every(2ms, "Quick");
  const Counter& slow = count_every(20ms, "Slow");
  const Gain& last = blueprint.add<Gain>("Last");
  Gain& both = blueprint.add<Gain>("Both");
  blueprint.connect("Quick.Count", "Both.In");
  blueprint.connect("Both.Out", "Last.In");
  const Hearing hearing(both, "of the other");
  blueprint.add_peer("Both", "Slow");
  EXPECT_EQ(problems(), "");
  EXPECT_TRUE(both.pace().ambiguous());
  EXPECT_EQ(both.period(), 0ms);
  EXPECT_EQ(both.pace().period, 2ms);
  EXPECT_EQ(both.pace().owner, &quick);
  EXPECT_EQ(both.pace().other, 20ms);
  EXPECT_EQ(both.pace().other_owner, &slow);
  EXPECT_TRUE(last.pace().ambiguous());
}

TEST_F(PlanPeriods, TwoThatAreEqualAreOne) {
  count_every(2ms, "One");
  count_every(2ms, "Other");
  const Sink& told = blueprint.add<Sink>("Told");
  const Gain& gain = blueprint.add<Gain>("Gain");
  blueprint.connect("One.Count", "Gain.In");
  blueprint.connect("Gain.Out", "Told.In");
  blueprint.add_peer("Told", "Other");
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(gain.period(), 2ms);
  EXPECT_EQ(told.period(), 2ms);
}

TEST_F(PlanPeriods, WhoIsOnlyCalledHasThatOfItsCaller) {
  count_every(2ms);
  Asking& asking = blueprint.add<Asking>("Asking");
  const Served& served = blueprint.add<Served>("Served");
  const Hearing hearing(asking, "of the counter");
  blueprint.add_peer("Asking", "Counter");
  blueprint.add_peer("Asking", "Served");
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(asking.period(), 2ms);
  EXPECT_EQ(served.period(), 2ms);
}

TEST_F(PlanPeriods, ACallOfWhoIsTriggeredByAnotherChangesNothing) {
  count_every(2ms);
  blueprint.add<Asking>("Asking", Activity::periodic(50ms));
  Served& served = blueprint.add<Served>("Served");
  const Hearing hearing(served, "of the counter");
  blueprint.add_peer("Served", "Counter");
  blueprint.add_peer("Asking", "Served");
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(served.period(), 2ms);
}

TEST_F(PlanPeriods, WhatIsRaisedOccasionallySaysNothing) {
  count_every(2ms);
  blueprint.add<Bell>("Bell", Activity::periodic(50ms));
  Gain& gain = blueprint.add<Gain>("Gain");
  component::EventHandler<> rung{&gain, "Rung", +[](void*) {}, nullptr, "of the bell"};
  blueprint.connect("Counter.Count", "Gain.In");
  blueprint.add_peer("Gain", "Bell");
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(gain.period(), 2ms);
}

TEST_F(PlanPeriods, WhatNeverRunsTogetherTriggersNobody) {
  count_every(2ms, "Quick");
  count_every(20ms, "Slow");
  const Gain& gain = blueprint.add<Gain>("Gain");
  blueprint.connect("Quick.Count", "Gain.In");
  blueprint.connect("Slow.Count", "Gain.In");
  blueprint.add_mode("quick", {{"Quick", {}}, {"Gain", {}}});
  blueprint.add_mode("slow", {{"Slow", {}}});
  problems();
  EXPECT_EQ(gain.period(), 2ms);
}

/// Notes what it knows when it is configured.
class Knowing final : public component::Component {
 public:
  using Component::Component;
  base::Duration known{};
  component::EventHandler<std::int64_t> tick{this, "Tick", component::serve<&Knowing::on_tick>,
                                             "of the counter"};

 private:
  component::Outcome on_configure() override {
    known = period();
    return component::accepted();
  }
  void on_tick(std::int64_t) {}
};

TEST_F(PlanPeriods, IsKnownWhenAComponentIsConfigured) {
  count_every(2ms);
  const Knowing& knowing = blueprint.add<Knowing>("Knowing");
  blueprint.add_peer("Knowing", "Counter");
  Application application(std::move(blueprint), patient(true));
  EXPECT_EQ(application.start().to_text(), "");
  EXPECT_EQ(knowing.known, 2ms);
}

}  // namespace
}  // namespace armature::exec
