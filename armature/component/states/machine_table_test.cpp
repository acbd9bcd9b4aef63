// SPDX-License-Identifier: Apache-2.0
// Tables of state machines: made at run time, looked up, checked.
#include "armature/component/states/machine_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;
using Cause = MachineTransition::Cause;

MachineState named(std::string name, int parent = kNoState) {
  MachineState state;
  state.name = std::move(name);
  state.parent = parent;
  return state;
}

MachineTransition on_trigger(int source, int target, std::size_t trigger) {
  MachineTransition transition;
  transition.source = source;
  transition.target = target;
  transition.trigger = trigger;
  return transition;
}

/// Idle; Moving with Fast and Slow.
MachineTable small_table() {
  MachineTable table;
  table.states = {named("Idle"), named("Moving"), named("Fast", 1), named("Slow", 1)};
  table.triggers = {"go", "brake"};
  table.transitions = {on_trigger(0, 1, 0), on_trigger(2, 3, 1), on_trigger(1, 0, 1)};
  return table;
}

TEST(MachineTable, NamesItsStatesByPaths) {
  const MachineTable table = small_table();
  EXPECT_EQ(table.path(3), "Moving/Slow");
  EXPECT_EQ(table.path(kNoState), "");
  EXPECT_EQ(table.initial(kNoState), 0);
  EXPECT_EQ(table.initial(1), 2);
  EXPECT_EQ(table.initial(2), kNoState);
  EXPECT_TRUE(table.contains(1, 3));
  EXPECT_FALSE(table.contains(1, 1));
  EXPECT_TRUE(table.contains(kNoState, 0));
}

TEST(MachineTable, FindsANameFromTheInsideOutwards) {
  MachineTable table = small_table();
  table.states.push_back(named("Slow"));
  EXPECT_EQ(table.find("Slow"), 4);
  EXPECT_EQ(table.find("Slow", 2), 3) << "beside Fast";
  EXPECT_EQ(table.find("Slow", 0), 4);
  EXPECT_EQ(table.find("Fast", 1), 2) << "inside Moving";
  EXPECT_EQ(table.find("Moving/Fast", 0), 2);
  EXPECT_EQ(table.find("Idle", 3), 0);
  EXPECT_EQ(table.find("Fast", 0), kNoState);
  EXPECT_EQ(table.find("Moving/Nothing", 0), kNoState);
}

TEST(MachineTable, WritesTransitionsAsTheyAreSpoken) {
  MachineTable table = small_table();
  EXPECT_EQ(table.text(table.transitions[0]), "Idle -> Moving on go");
  MachineTransition transition = on_trigger(1, kNoState, 0);
  transition.guard = {[](void*) { return true; }, nullptr, "is_free"};
  transition.action = {[](void*) {}, nullptr, "note"};
  EXPECT_EQ(table.text(transition), "Moving on go [is_free] / note");
  transition = on_trigger(0, 1, 0);
  transition.to_history = true;
  transition.cause = Cause::kTime;
  transition.after = std::chrono::microseconds(1500);
  EXPECT_EQ(table.text(transition), "Idle -> back to Moving after 1500 us");
  transition.cause = Cause::kDone;
  EXPECT_EQ(table.text(transition), "Idle -> back to Moving when done");
}

class Empty : public Component {
 public:
  using Component::Component;
};

TEST(MachineTable, AMachineCanBeMadeOfItAtRunTime) {
  Empty component("scripted");
  TestThread thread(component);
  struct Script {
    int entered = 0;
    bool allowed = false;
  } script;
  MachineTable table = small_table();
  table.states[3].entry = {[](void* self) { ++static_cast<Script*>(self)->entered; }, &script, ""};
  table.transitions[1].guard = {[](void* self) { return static_cast<Script*>(self)->allowed; },
                                &script, ""};
  {
    StateMachine machine(&component, "from a script", "made at run time", table);
    EXPECT_THAT(interface_of(component).machines, ElementsAre(&machine));
    start(component);
    EXPECT_EQ(machine.post(0), TriggerStatus::kTaken);
    EXPECT_EQ(machine.path(), "Moving/Fast");
    script.allowed = true;
    EXPECT_EQ(machine.post(1), TriggerStatus::kTaken);
    EXPECT_EQ(machine.path(), "Moving/Slow");
    EXPECT_EQ(script.entered, 1);
    Host::stop(component);
  }
  EXPECT_THAT(interface_of(component).machines, ElementsAre());
  start(component);
  Host::update(component);
}

// --- mistakes ------------------------------------------------------------------------------------

TEST(MachineTableCheck, ASoundTableHasNoProblems) {
  EXPECT_THAT(check_table(small_table()), ElementsAre());
}

TEST(MachineTableCheck, NamesEveryMistakeInOneGo) {
  MachineTable table = small_table();
  table.states.push_back(named("Slow", 1));
  table.states.push_back(named("a/b"));
  table.states.push_back(named(""));
  table.triggers.push_back("go");
  table.transitions.push_back(on_trigger(0, 4, 0));
  table.transitions.push_back(on_trigger(0, 5, 0));
  EXPECT_THAT(
      check_table(table),
      ElementsAre("state 'Moving/Slow' exists twice", "the name of state 'a/b' contains '/'",
                  "a state has no name", "trigger 'go' exists twice", "state '' is never entered"));
}

TEST(MachineTableCheck, AnEmptyTableIsAMistake) {
  EXPECT_THAT(check_table({}), ElementsAre("it has no states"));
}

TEST(MachineTableCheck, AStateComesAfterItsParent) {
  MachineTable table;
  table.states = {named("Inner", 1), named("Outer")};
  EXPECT_THAT(check_table(table), ElementsAre("state 'Inner' comes before its parent"));
}

TEST(MachineTableCheck, ATransitionRefersToWhatExists) {
  for (const MachineTransition& wrong :
       {on_trigger(9, 0, 0), on_trigger(0, 9, 0), on_trigger(0, 1, 9), on_trigger(-1, 0, 0)}) {
    MachineTable table = small_table();
    table.transitions.push_back(wrong);
    EXPECT_THAT(check_table(table),
                ElementsAre("a transition refers to a state or trigger that does not exist"));
  }
}

TEST(MachineTableCheck, FinalStatesAreNeverLeftAndHaveNothingInside) {
  MachineTable table = small_table();
  table.states[1].final = true;
  EXPECT_THAT(check_table(table),
              ElementsAre("state 'Moving' is final and has substates",
                          "transition 'Moving -> Idle on brake': a final state is never left"));
}

struct Mistake {
  Cause cause;
  int source;
  int target;
  const char* problem;
};

TEST(MachineTableCheck, TransitionsOnTimeConditionAndCompletionAreComplete) {
  const std::vector<Mistake> mistakes{
      {Cause::kTime, 0, 1, "transition 'Idle -> Moving after 0 ms': the time must be above 0"},
      {Cause::kTime, 0, kNoState,
       "transition 'Idle after 0 ms': it needs a target state; put what happens all the time into "
       "`during`"},
      {Cause::kCondition, 0, 1,
       "transition 'Idle -> Moving when its condition holds': it has no condition"},
      {Cause::kDone, 1, 0,
       "transition 'Moving -> Idle when done': state 'Moving' has no final substate, so it is "
       "never "
       "done"}};
  for (const Mistake& mistake : mistakes) {
    MachineTable table = small_table();
    table.transitions.push_back(on_trigger(mistake.source, mistake.target, 0));
    table.transitions.back().cause = mistake.cause;
    EXPECT_THAT(check_table(table), ElementsAre(mistake.problem));
  }
}

TEST(MachineTableCheck, OnlyAStateWithSubstatesCanBeGoneBackTo) {
  MachineTable table = small_table();
  table.transitions[2].to_history = true;
  EXPECT_THAT(check_table(table),
              ElementsAre("transition 'Moving -> back to Idle on brake': state 'Idle' has no "
                          "substates to go back to"));
}

TEST(MachineTableCheck, AStateThatNothingLeadsToIsAMistake) {
  MachineTable table = small_table();
  table.states.push_back(named("Forgotten"));
  table.states.push_back(named("Inside", 4));
  EXPECT_THAT(check_table(table), ElementsAre("state 'Forgotten' is never entered",
                                              "state 'Forgotten/Inside' is never entered"));
}

// --- definitions in C++ --------------------------------------------------------------------------

class Misspelt : public Component {
 public:
  using Component::Component;
  Trigger go{"go"};
  StateMachine mode{this,
                    "mode",
                    "has a mistake",
                    in_state("Idle", on(go, to("Movin")), on(go, to("Moving"))),
                    in_state("Moving"),
                    on(go, to("Idle"))};
};

TEST(MachineDefinition, AMisspeltStateIsFoundWhenConfiguringWithASuggestion) {
  Misspelt component("chassis");
  EXPECT_THAT(
      component.mode.problems(),
      ElementsAre(
          "a transition to 'Idle' stands outside of all states",
          "a transition of state 'Idle' goes to 'Movin', which does not exist; did you mean "
          "'Moving'?"));
  const Outcome outcome = Host::configure(component);
  EXPECT_FALSE(outcome);
  EXPECT_EQ(outcome.reason(),
            "state machine 'mode': a transition to 'Idle' stands outside of all states");
  EXPECT_EQ(component.state(), State::kPreOperational);
}

}  // namespace
}  // namespace armature::component
