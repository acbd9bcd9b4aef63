// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/describe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::inspect {

using namespace component;
namespace {

using testing::ElementsAre;

/// Has one of everything.
class Drive : public Component {
 public:
  using Component::Component;
  Property<int> joints{this, "joints", 2, "number of joints", "", range(1, 7)};
  Property<std::string> card_name{this, "card", "card1", "which card", "", mandatory};
  Attribute<double> load{this, "load", 0.25, "of the motor", "A", changeable_while_running};
  InputPort<std::vector<double>> reference{this,
                                           "Ref",
                                           "desired",
                                           "rad",
                                           size_of(joints, 3),
                                           on_data_update,
                                           max_age(std::chrono::milliseconds(5), Reaction::kFault),
                                           on_lost(Reaction::kZero)};
  InputPort<int> extra{this, "Extra", "if there is one", "", may_stay_open, fan_in};
  InputPorts<double> positions{this, "Position", joints, "of each", "rad"};
  OutputPort<double> out{this, "Out", "control signal", "V"};
  Operation<double(double)> scale{this, "scale", serve<&Drive::do_scale>, "scales", args("x [m]")};
  Command<double> move{this, "moveTo", serve<&Drive::do_move>, "moves"};
  OperationCaller<void()> motor_on{this, "motorOn", "switches on", from(card_name)};
  CommandCaller<double> home{this, "home", "finds zero", optional};
  Event<int> moved{this, "moved", "it moved", {"steps"}};
  EventHandler<> tick{this, "tick", serve<&Drive::do_tick>, "of the clock"};
  OperationTrigger arm{this, "arm", "arms"};
  StateMachine mode{this, "mode", "whether it is armed",
                    in_state("Safe", "nothing moves", on(arm, to("Armed"))), in_state("Armed")};

 private:
  double do_scale(double x) { return x; }
  Outcome do_move(double) { return accepted(); }
  void do_tick() {}
};

class Card : public Component {
 public:
  using Component::Component;
  OutputPort<int> ticks{this, "Ticks", "counts"};
  InputPort<double> voltage{this, "Voltage", "for the motor", "V"};
  Operation<void()> on{this, "motorOn", serve<&Card::nothing>, "switches on", in_own_thread};
  EventHandler<int> moved{this, "moved", serve<&Card::count>, "notes it"};

 private:
  void nothing() {}
  void count(int) {}
};

class Description : public testing::Test {
 protected:
  Description() : thread_(drive_, card_) {
    face(drive_.out).connect(face(card_.voltage), {});
    face(card_.ticks).connect(face(drive_.extra), {});
    face(drive_.moved).subscribe(face(card_.moved));
    face(drive_.motor_on).connect(face(card_.on));
    start(drive_);
  }
  ComponentDescription describe() { return inspect::describe(drive_, "Drive"); }
  Drive drive_{"joint1"};
  Card card_{"card1"};
  TestThread thread_;
};

TEST_F(Description, NamesModelComponentStateAndReason) {
  EXPECT_EQ(describe().model, "Drive");
  EXPECT_EQ(describe().name, "joint1");
  EXPECT_EQ(describe().state, State::kRunning);
  drive_.fault("encoder lost");
  EXPECT_EQ(describe().state, State::kException);
  EXPECT_EQ(describe().reason, "encoder lost");
}

TEST_F(Description, OfProperties) {
  const std::vector<PropertyDescription> properties = describe().properties;
  ASSERT_EQ(properties.size(), 3u);
  const PropertyDescription& joints = properties[0];
  EXPECT_EQ(joints.name, "joints");
  EXPECT_EQ(joints.doc, "number of joints");
  EXPECT_EQ(joints.type, "int32");
  EXPECT_EQ(joints.value, "2");
  ASSERT_TRUE(joints.range);
  EXPECT_EQ(joints.range->low, 1.0);
  EXPECT_EQ(joints.range->high, 7.0);
  EXPECT_TRUE(joints.persistent);
  EXPECT_FALSE(joints.mandatory);
  EXPECT_TRUE(properties[1].mandatory);
  EXPECT_FALSE(properties[1].was_set);
  EXPECT_EQ(properties[1].value, "card1");
  EXPECT_FALSE(properties[2].persistent);
  EXPECT_TRUE(properties[2].changeable_while_running);
  EXPECT_EQ(properties[2].unit, "A");
}

TEST_F(Description, OfInputs) {
  card_.ticks.write(1);
  card_.ticks.write(2);
  EXPECT_EQ(drive_.extra.read().value, 2);
  const std::vector<InputDescription> inputs = describe().inputs;
  ASSERT_EQ(inputs.size(), 4u);
  const InputDescription& reference = inputs[0];
  EXPECT_EQ(reference.name, "Ref");
  EXPECT_EQ(reference.type, "vector<double>");
  EXPECT_EQ(reference.unit, "rad");
  EXPECT_EQ(reference.size, 6u);
  EXPECT_TRUE(reference.triggers);
  EXPECT_FALSE(reference.connected());
  EXPECT_EQ(reference.max_age, std::chrono::milliseconds(5));
  EXPECT_EQ(reference.when_stale, Reaction::kFault);
  EXPECT_EQ(reference.when_lost, Reaction::kZero);
  EXPECT_EQ(reference.sequence, 0u);
  const InputDescription& extra = inputs[1];
  EXPECT_THAT(extra.peers, ElementsAre("card1.Ticks"));
  EXPECT_TRUE(extra.may_stay_open);
  EXPECT_TRUE(extra.allows_fan_in);
  EXPECT_FALSE(extra.size);
  EXPECT_EQ(extra.value, "2");
  EXPECT_EQ(extra.sequence, 2u);
  EXPECT_EQ(extra.counters.missed, 1u);
  EXPECT_EQ(inputs[2].name, "Position1");
  EXPECT_EQ(inputs[3].name, "Position2");
}

TEST_F(Description, OfOutputsAndArrays) {
  drive_.out.write(1.5);
  const ComponentDescription description = describe();
  ASSERT_EQ(description.outputs.size(), 1u);
  const OutputDescription& out = description.outputs[0];
  EXPECT_EQ(out.name, "Out");
  EXPECT_EQ(out.doc, "control signal");
  EXPECT_EQ(out.value, "1.5");
  EXPECT_EQ(out.sequence, 1u);
  EXPECT_THAT(out.peers, ElementsAre("card1.Voltage"));
  EXPECT_EQ(out.counters.refused, 0u);
  ASSERT_EQ(description.port_arrays.size(), 1u);
  EXPECT_EQ(description.port_arrays[0].name, "Position");
  EXPECT_EQ(description.port_arrays[0].count, "joints");
}

TEST_F(Description, OfOperationsAndCommands) {
  const std::vector<OperationDescription> operations = describe().operations;
  ASSERT_EQ(operations.size(), 3u);
  EXPECT_EQ(operations[0].name, "scale");
  EXPECT_EQ(operations[0].signature, "double(double x [m])");
  EXPECT_FALSE(operations[0].own_thread);
  EXPECT_FALSE(operations[0].command);
  EXPECT_EQ(operations[1].name, "moveTo");
  EXPECT_TRUE(operations[1].own_thread);
  EXPECT_TRUE(operations[1].command);
  EXPECT_EQ(operations[2].name, "arm") << "a trigger of the state machine";
  EXPECT_EQ(operations[2].signature, "bool()");
}

TEST_F(Description, OfEventsAndRequirements) {
  drive_.moved.raise(3);
  const ComponentDescription description = describe();
  ASSERT_EQ(description.events.size(), 1u);
  EXPECT_EQ(description.events[0].signature, "void(int32 steps)");
  EXPECT_EQ(description.events[0].raised, 1u);
  EXPECT_THAT(description.events[0].subscribers, ElementsAre("card1"));
  ASSERT_EQ(description.requirements.size(), 3u);
  const RequirementDescription& motor_on = description.requirements[0];
  EXPECT_EQ(motor_on.name, "motorOn");
  EXPECT_EQ(motor_on.peer, "card1");
  EXPECT_EQ(motor_on.bound_to, "card1.motorOn");
  EXPECT_FALSE(motor_on.optional);
  EXPECT_FALSE(motor_on.event);
  const RequirementDescription& home = description.requirements[1];
  EXPECT_TRUE(home.command);
  EXPECT_TRUE(home.optional);
  EXPECT_EQ(home.bound_to, "");
  EXPECT_TRUE(description.requirements[2].event);
  EXPECT_EQ(inspect::describe(card_, "Card").requirements[0].bound_to, "joint1.moved");
}

TEST_F(Description, OfStateMachines) {
  drive_.arm.raise();
  const std::vector<MachineDescription> machines = describe().machines;
  ASSERT_EQ(machines.size(), 1u);
  const MachineDescription& mode = machines[0];
  EXPECT_EQ(mode.name, "mode");
  EXPECT_EQ(mode.doc, "whether it is armed");
  ASSERT_EQ(mode.states.size(), 2u);
  EXPECT_EQ(mode.states[0].path, "Safe");
  EXPECT_EQ(mode.states[0].doc, "nothing moves");
  EXPECT_THAT(mode.transitions, ElementsAre("Safe -> Armed on arm"));
  EXPECT_THAT(mode.triggers, ElementsAre("arm"));
  EXPECT_THAT(mode.problems, ElementsAre());
  EXPECT_EQ(mode.current, "Armed");
}

TEST_F(Description, LeavesValuesOutIfTheyAreNotAskedFor) {
  drive_.out.write(1.5);
  const ComponentDescription description = inspect::describe(drive_, "Drive", Values::kLeftOut);
  EXPECT_EQ(description.properties[0].value, "");
  EXPECT_EQ(description.outputs[0].value, "");
  EXPECT_EQ(description.outputs[0].sequence, 1u);
}

TEST_F(Description, OutlivesTheComponent) {
  ComponentDescription description;
  {
    Drive passing("passing");
    description = inspect::describe(passing, "Drive");
  }
  EXPECT_EQ(description.name, "passing");
  EXPECT_EQ(description.properties[0].doc, "number of joints");
}

}  // namespace
}  // namespace armature::inspect
