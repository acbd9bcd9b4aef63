// SPDX-License-Identifier: Apache-2.0
// What is checked of modes before anything runs.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/face.hpp"
#include "armature/component/holding.hpp"
#include "armature/exec/internal/test_components.hpp"
#include "armature/exec/modes.hpp"

namespace armature::exec {
namespace {

using ::testing::HasSubstr;

/// Passes on; its handler sets off whatever is behind it.
class Pass : public component::Component {
 public:
  using Component::Component;
  component::InputPort<double> in{this, "In", "value", "rad", component::on_data<&Pass::step>};
  component::OutputPort<double> out{this, "Out", "the same", "rad"};

 private:
  void step(double value) { out.write(value); }
};

class Caller : public component::Component {
 public:
  using Component::Component;
  component::OperationCaller<double(double)> scale{this, "scale", "asks a peer"};
};

std::vector<ModeMember> members(std::initializer_list<const char*> names) {
  std::vector<ModeMember> all;
  for (const char* name : names) all.push_back({name, {}});
  return all;
}

/// A source, two gains that take turns, and who reads them.
struct Turns {
  Blueprint blueprint;

  Turns() {
    blueprint.add<Counter>("Source", Activity::periodic(10ms));
    blueprint.add<Gain>("A");
    blueprint.add<Gain>("B");
    blueprint.add<Pass>("Last");
    blueprint.connect("Source.Count", "A.In");
    blueprint.connect("Source.Count", "B.In");
    blueprint.connect("A.Out", "Last.In");
    blueprint.connect("B.Out", "Last.In");
  }
  Turns& mode(const char* name, std::initializer_list<const char*> names) {
    blueprint.add_mode(name, members(names));
    return *this;
  }
  std::string problems() const { return problems_of(blueprint); }
};

TEST(PlanModes, WritersOfOneInputMayTakeTurns) {
  Turns turns;
  turns.mode("a", {"A"}).mode("b", {"B"});
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(turns.blueprint, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  ASSERT_EQ(plan.in_turns.size(), 1u);
  EXPECT_EQ(plan.in_turns[0]->owner().name(), "Last");
  EXPECT_EQ(plan.thread_of.back(), plan.thread_of[0]) << "modes are switched where they live";
  EXPECT_EQ(plan.initial_mode, 0u);
}

TEST(PlanModes, TwoWritersInOneModeAreAMistakeThatNamesIt) {
  EXPECT_EQ(Turns().mode("a", {"A"}).mode("both", {"A", "B"}).problems(),
            "error: 'Last.In' has two writers in the mode 'both': 'A.Out' and 'B.Out' (an input "
            "takes several writers only if its component declares fan_in, or if no mode has more "
            "than one of them)\n");
}

TEST(PlanModes, AWriterThatAlwaysRunsTakesNoTurns) {
  EXPECT_NE(Turns()
                .mode("a", {"A"})
                .mode("none", {"Last"})
                .problems()
                .find("'Last.In' has two writers in the mode 'a'"),
            std::string::npos);
}

TEST(PlanModes, AnInputThatNobodyWritesInAModeIsAMistakeThatNamesIt) {
  Turns turns;
  turns.blueprint.connections.pop_back();
  turns.mode("a", {"A"}).mode("b", {"B"});
  EXPECT_EQ(turns.problems(),
            "error: input 'Last.In' has no writer in the mode 'b' (connect an output to it)\n");
}

TEST(PlanModes, AFifoOfOneOfThemIsAMistake) {
  Turns turns;
  turns.blueprint.connections.back().policy = {component::ConnectionPolicy::Kind::kFifo, 4};
  turns.mode("a", {"A"}).mode("b", {"B"});
  EXPECT_EQ(turns.problems(),
            "error: the writers of 'Last.In' take turns, and one of them has a FIFO, in which old "
            "values wait (use the policy latest)\n");
}

TEST(PlanModes, UnknownNamesAreAnsweredWithTheNearest) {
  Turns turns;
  turns.mode("first", {"A"}).mode("second", {"B", "Suorce"});
  turns.blueprint.initial_mode = {"secnd", {}};
  EXPECT_EQ(turns.problems(),
            "error: the mode 'second' has the unknown component 'Suorce' (did you mean "
            "'Source'?)\n"
            "error: unknown mode 'secnd' (did you mean 'second'?)\n");
}

TEST(PlanModes, EmptyOnesAndNamesThatAreTakenAreMistakes) {
  Turns turns;
  turns.mode("a", {"A"}).mode("b", {"B", "B"}).mode("b", {}).mode("c", {"Modes"});
  turns.mode(std::string(64, 'x').c_str(), {"A"});
  EXPECT_EQ(
      turns.problems(),
      "error: 'B' is named twice in the mode 'b'\n"
      "error: two modes are named 'b'\n"
      "error: the mode 'b' has no components (name those that run in it and not in other "
      "modes)\n"
      "error: 'Modes' switches between modes: it runs in all\n"
      "error: the name of a mode has 1 to 63 letters: '" +
          std::string(64, 'x') +
          "'\n"
          "error: input 'Last.In' has no writer in the modes 'b', 'c' (connect an output to it)\n");
}

TEST(PlanModes, AModeWithoutModesIsAMistake) {
  Turns turns;
  turns.blueprint.connections.pop_back();
  turns.blueprint.initial_mode = {"a", {}};
  EXPECT_EQ(turns.problems(),
            "error: unknown mode 'a': the deployment has no modes (add modes: {NAME: "
            "[COMPONENT, COMPONENT]})\n");
}

TEST(PlanModes, WhatIsNotStartedWithTheApplicationIsInNoMode) {
  Turns turns;
  turns.mode("a", {"A"}).mode("b", {"B"});
  turns.blueprint.components[2].autostart = false;
  EXPECT_EQ(turns.problems(),
            "error: 'B' is in the mode 'b', but does not start with the application (leave "
            "autostart and autoconf on: its modes say when it runs)\n");
}

TEST(PlanModes, WhatTheySwitchLivesInOneThread) {
  Turns turns;
  turns.mode("a", {"A"}).mode("b", {"B"});
  turns.blueprint.components[2].activity = Activity::triggered();
  EXPECT_EQ(
      turns.problems(),
      "error: 'B' runs in the thread 'B', 'A' in 'Source': components that modes switch must share "
      "one thread (give both the same activity, or have the same thread trigger both)\n");
}

TEST(PlanModes, APeerThatNeverRunsAtTheSameTimeIsAMistake) {
  Turns turns;
  turns.blueprint.add<Caller>("Caller");
  turns.blueprint.add_peer("Caller", "B");
  turns.mode("a", {"A", "Caller"}).mode("b", {"B"});
  EXPECT_THAT(turns.problems(),
              HasSubstr("error: 'Caller' uses 'scale' of 'B', but no mode runs both\n"));
}

/// Hands on what it hears.
class Relay : public component::Component {
 public:
  using Component::Component;

 private:
  void pass(std::int64_t count) { beat_.raise(count); }

  component::Event<std::int64_t> beat_{this, "Beat", "what it hears"};
  component::EventHandler<std::int64_t> tick_{this, "Tick", component::serve<&Relay::pass>, ""};
};

/// Holds something as long as it hears a beat.
class Holder : public component::Component {
 public:
  using Component::Component;

 private:
  component::Reason held() { return component::Reason("a load"); }
  void count(std::int64_t) {}

  component::EventHandler<std::int64_t> beat_{this, "Beat", component::serve<&Holder::count>, ""};
  component::Holding holding_{this, component::serve<&Holder::held>, beat_};
};

/// Something is held by the beat of a relay that a clock triggers, beside what modes switch.
struct Held : Turns {
  Held() {
    blueprint.add<Counter>("Clock", Activity::periodic(10ms));
    blueprint.add<Relay>("Relay");
    blueprint.add<Holder>("Holder");
    blueprint.add_peer("Relay", "Clock");
    blueprint.add_peer("Holder", "Relay");
  }
};

TEST(PlanModes, MayLeaveOutNobodyWhoHoldsSomething) {
  Held held;
  held.mode("a", {"A", "Holder"}).mode("b", {"B"});
  EXPECT_THAT(held.problems(),
              HasSubstr("error: a switch of modes would let go: 'Holder', which holds something, "
                        "does not run in the mode 'b' (name it in no mode: then it runs in all)"));
}

TEST(PlanModes, MayLeaveOutNobodyWhomTheHolderNeeds) {
  for (const char* needed : {"Relay", "Clock"}) {
    Held held;
    held.mode("a", {"A"}).mode("b", {"B", needed});
    EXPECT_THAT(held.problems(),
                HasSubstr("'" + std::string(needed) +
                          "', without which 'Holder' holds nothing, does not run in the mode 'a'"));
  }
}

TEST(PlanModes, MayLeaveOutWhoHasNothingToDoWithWhatIsHeld) {
  Held held;
  held.mode("a", {"A"}).mode("b", {"B"});
  EXPECT_EQ(held.problems(), "");
}

/// A loop of handlers through whichever of two runs.
struct Loop : Turns {
  Loop() {
    blueprint.add<Pass>("Back");
    blueprint.connections.erase(blueprint.connections.begin());  // not from the source to A
    blueprint.connect("Last.Out", "Back.In");
    blueprint.connect("Back.Out", "A.In");
  }
};

TEST(PlanModes, ALoopOfHandlersIsAMistakeOfTheModeThatHasIt) {
  Loop loop;
  loop.mode("a", {"A"}).mode("b", {"B"});
  const std::string problems = loop.problems();
  EXPECT_NE(problems.find("handlers may set each other off without end in the mode 'a': "),
            std::string::npos)
      << problems;
  EXPECT_EQ(problems.find("handlers"), problems.rfind("handlers may")) << "told once: " << problems;
}

TEST(PlanModes, ALoopThatNoModeClosesIsNone) {
  Loop loop;
  loop.blueprint.add<Counter>("Other", Activity::periodic(10ms));
  loop.mode("a", {"A"}).mode("b", {"B", "Back"});
  const std::string problems = loop.problems();
  EXPECT_EQ(problems.find("handlers"), std::string::npos) << problems;
}

TEST(PlanModes, TheOrderSaysInWhichModeWhatRuns) {
  Turns turns;
  turns.mode("a", {"A"}).mode("b", {"B"});
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(turns.blueprint, diagnostics);
  const std::string order = describe_order(turns.blueprint, plan);
  EXPECT_NE(order.find("  hosts A in the mode 'a'\n"), std::string::npos) << order;
  EXPECT_NE(order.find("  hosts Last\n"), std::string::npos) << order;
}

}  // namespace
}  // namespace armature::exec
