// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using namespace component;

class Writer final : public Component {
 public:
  using Component::Component;
  OutputPort<double> position{this, "Position", "an angle", "rad"};
  OutputPort<double> degrees{this, "Degrees", "an angle", "deg"};
  OutputPort<double> level{this, "Level", "a plain number"};
  OutputPort<double> rate{this, "Rate", "how often", "1/s"};
  OutputPort<int> count{this, "Count", "a whole number"};
  OutputPort<std::vector<double>> three{this, "Three", "three values", "", fixed_size(3)};
};

class Reader final : public Component {
 public:
  using Component::Component;
  InputPort<double> angle{this, "Angle", "an angle", "rad", may_stay_open};
  InputPort<double> speed{this, "Speed", "a speed", "rad/s", may_stay_open};
  InputPort<double> frequency{this, "Frequency", "how often", "Hz", may_stay_open};
  InputPort<double> level{this, "Level", "a plain number", "", may_stay_open};
  InputPort<double> all{this, "All", "a plain number", "", fan_in, may_stay_open};
  InputPort<std::vector<double>> two{this, "Two", "two values", "", fixed_size(2), may_stay_open};
  InputPort<std::vector<double>> any{this, "Any", "values", "", may_stay_open};
  OutputPort<double> out{this, "Out", "a plain number"};
};

class Misdeclared final : public Component {
 public:
  using Component::Component;
  InputPort<double> speed{this, "Speed", "a speed, in a unit that there is not", "rad/sec"};
};

class NeedsInput final : public Component {
 public:
  using Component::Component;
  InputPort<double> in{this, "In", "must be connected"};
};

/// One writer and one reader, without connections.
Blueprint pair() {
  Blueprint blueprint;
  blueprint.add<Writer>("Writer");
  blueprint.add<Reader>("Reader");
  return blueprint;
}

std::string problems_with(const char* from, const char* to, ConnectionPolicy policy = {}) {
  Blueprint blueprint = pair();
  blueprint.connect(from, to, policy);
  return problems_of(blueprint);
}

TEST(PlanConnections, WhatFitsIsConnectedWithoutEffectOnTheComponents) {
  Blueprint blueprint = pair();
  blueprint.connect("Writer.Position", "Reader.Angle");
  blueprint.connect("Writer.Level", "Reader.Level");
  blueprint.connect("Writer.Three", "Reader.Any");
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  ASSERT_EQ(plan.connections.size(), 3u);
  EXPECT_EQ(plan.connections[0].output->name(), "Position");
  EXPECT_EQ(plan.connections[0].input->name(), "Angle");
  EXPECT_EQ(plan.connections[0].from, 0u);
  EXPECT_EQ(plan.connections[0].to, 1u);
  EXPECT_FALSE(plan.connections[0].input->connected());
}

TEST(PlanConnections, AnUnknownComponentIsNamedWithTheNearest) {
  EXPECT_EQ(problems_with("Wrtier.Level", "Reader.Level"),
            "error: unknown component 'Wrtier' (did you mean 'Writer'?)\n");
  EXPECT_EQ(problems_with("Writer.Level", "Plotter.Level"),
            "error: unknown component 'Plotter' (known: Writer, Reader)\n");
}

TEST(PlanConnections, AnUnknownPortIsNamedWithTheNearest) {
  EXPECT_EQ(problems_with("Writer.Positon", "Reader.Angle"),
            "error: 'Writer' has no output port 'Positon' (did you mean 'Position'?)\n");
  EXPECT_EQ(problems_with("Writer.Position", "Reader.angle"),
            "error: 'Reader' has no input port 'angle' (did you mean 'Angle'?)\n");
  EXPECT_EQ(problems_with("Writer.Level", "Reader.Temperature"),
            "error: 'Reader' has no input port 'Temperature' (known: Angle, Speed, Frequency, "
            "Level, All, Two, Any)\n");
}

TEST(PlanConnections, ThePlaceInTheFileLeadsTheMessage) {
  Blueprint blueprint = pair();
  blueprint.connect("Writer.Level", "Reader.Levle");
  blueprint.connections[0].where = {"robot.yaml", 12, 5};
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:12:5: error: 'Reader' has no input port 'Levle' (did you mean 'Level'?)\n");
}

TEST(PlanConnections, AConnectionGoesFromAnOutputToAnInput) {
  EXPECT_EQ(problems_with("Reader.Level", "Reader.Any"),
            "error: 'Reader.Level' is an input port, and a connection starts at an output port "
            "(known: Out)\n");
  EXPECT_EQ(problems_with("Writer.Level", "Reader.Out"),
            "error: 'Reader.Out' is an output port, and a connection ends at an input port "
            "(known: Angle, Speed, Frequency, Level, All, Two, Any)\n");
}

TEST(PlanConnections, OneThatIsBackwardsIsOneMistake) {
  Blueprint blueprint;
  blueprint.add<Writer>("Writer");
  blueprint.add<NeedsInput>("Needs");
  blueprint.connect("Needs.In", "Writer.Level");
  EXPECT_EQ(problems_of(blueprint),
            "error: a connection goes from an output to an input, but 'Needs.In' is an input and "
            "'Writer.Level' an output (exchange its ends: Writer.Level -> Needs.In)\n");
}

TEST(PlanConnections, TypesMustBeTheSame) {
  EXPECT_EQ(problems_with("Writer.Count", "Reader.Level"),
            "error: 'Writer.Count' writes int32, but 'Reader.Level' reads double (connect ports of "
            "the same type)\n");
}

TEST(PlanConnections, UnitsMustBeOfTheSameKindAndSize) {
  EXPECT_EQ(problems_with("Writer.Position", "Reader.Speed"),
            "error: 'Writer.Position' is in 'rad', but 'Reader.Speed' expects 'rad/s' (connect "
            "ports of the same unit, or convert in a component between them)\n");
  EXPECT_EQ(problems_with("Writer.Degrees", "Reader.Angle"),
            "error: 'Writer.Degrees' is in 'deg', but 'Reader.Angle' expects 'rad' (connect ports "
            "of the same unit, or convert in a component between them)\n");
  EXPECT_EQ(problems_with("Writer.Level", "Reader.Speed"),
            "error: 'Writer.Level' is in plain numbers, but 'Reader.Speed' expects 'rad/s' "
            "(connect ports of the same unit, or convert in a component between them)\n");
  EXPECT_EQ(problems_with("Writer.Rate", "Reader.Level"),
            "error: 'Writer.Rate' is in '1/s', but 'Reader.Level' expects plain numbers (connect "
            "ports of the same unit, or convert in a component between them)\n");
}

TEST(PlanConnections, AUnitThatThereIsNotIsTheModelsMistake) {
  Blueprint blueprint = pair();
  blueprint.add<Misdeclared>("Other");
  blueprint.connect("Writer.Position", "Other.Speed");
  EXPECT_EQ(
      problems_of(blueprint),
      "error: 'Writer.Position' is in 'rad', but 'Other.Speed' expects 'rad/sec' (the model of "
      "'Other' declares the unknown unit 'rad/sec')\n");
}

TEST(PlanConnections, OneUnitMayBeWrittenInTwoWays) {
  EXPECT_EQ(problems_with("Writer.Rate", "Reader.Frequency"), "");
}

TEST(PlanConnections, VectorSizesMustFitWhereBothAreKnown) {
  EXPECT_EQ(problems_with("Writer.Three", "Reader.Two"),
            "error: 'Writer.Three' has 3 elements, but 'Reader.Two' expects 2 (give both the same "
            "number of elements)\n");
  EXPECT_EQ(problems_with("Writer.Three", "Reader.Any"), "");
}

TEST(PlanConnections, AnInputHasOneWriter) {
  Blueprint blueprint = pair();
  blueprint.add<Writer>("Second");
  blueprint.connect("Writer.Level", "Reader.Level");
  blueprint.connect("Second.Level", "Reader.Level");
  EXPECT_EQ(problems_of(blueprint),
            "error: 'Reader.Level' has two writers: 'Writer.Level' and 'Second.Level' (an input "
            "takes several writers only if its component declares fan_in)\n");
}

TEST(PlanConnections, AnInputWithFanInHasSeveral) {
  Blueprint blueprint = pair();
  blueprint.add<Writer>("Second");
  blueprint.connect("Writer.Level", "Reader.All");
  blueprint.connect("Second.Level", "Reader.All");
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST(PlanConnections, TheSameConnectionTwiceIsAMistakeWhateverThePolicy) {
  for (const char* input : {"Reader.Level", "Reader.All"}) {
    Blueprint blueprint = pair();
    blueprint.connect("Writer.Level", input);
    ConnectionPolicy fifo;
    fifo.kind = ConnectionPolicy::Kind::kFifo;
    fifo.capacity = 8;
    blueprint.connect("Writer.Level", input, fifo);
    EXPECT_EQ(problems_of(blueprint), "error: 'Writer.Level' is connected to '" +
                                          std::string(input) +
                                          "' already (remove one of the two connections)\n");
  }
}

TEST(PlanConnections, AFifoHoldsAtLeastOneValue) {
  ConnectionPolicy fifo;
  fifo.kind = ConnectionPolicy::Kind::kFifo;
  fifo.capacity = 0;
  EXPECT_EQ(problems_with("Writer.Level", "Reader.Level", fifo),
            "error: a FIFO of size 0 holds no value (give it a size of at least 1)\n");
}

TEST(PlanConnections, AFifoIsNotDelayed) {
  ConnectionPolicy fifo;
  fifo.kind = ConnectionPolicy::Kind::kFifo;
  fifo.one_cycle_delay = true;
  EXPECT_EQ(problems_with("Writer.Level", "Reader.Level", fifo),
            "error: a connection is either a FIFO or delayed by one cycle (use the policy latest "
            "with the delay)\n");
}

TEST(PlanConnections, AMaximumAgeIsAboveZero) {
  Blueprint blueprint = pair();
  blueprint.connect("Writer.Level", "Reader.Level");
  blueprint.connections[0].max_age = max_age(0ms);
  EXPECT_EQ(problems_of(blueprint), "error: the maximum age of a connection must be above 0\n");
}

TEST(PlanConnections, AnInputThatNobodyWritesIsAMistakeUnlessItMayStayOpen) {
  Blueprint blueprint = pair();
  blueprint.add<NeedsInput>("Needy");
  blueprint.components.back().where = {"robot.yaml", 3, 3};
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:3:3: error: input 'Needy.In' has no writer (connect an output to it)\n");
}

TEST(PlanConnections, AnInputWhoseConnectionIsWrongIsReportedOnce) {
  Blueprint blueprint = pair();
  blueprint.add<NeedsInput>("Needy");
  blueprint.connect("Writer.Count", "Needy.In");
  EXPECT_EQ(problems_of(blueprint),
            "error: 'Writer.Count' writes int32, but 'Needy.In' reads double (connect ports of the "
            "same type)\n");
}

TEST(PlanConnections, WhatRefersToAComponentThatCouldNotBeMadeIsNotReportedAgain) {
  Blueprint blueprint = pair();
  blueprint.add<NeedsInput>("Needy");
  blueprint.absent.insert("Broken");
  blueprint.connect("Broken.Out", "Needy.In");
  blueprint.connect("Writer.Level", "Broken.In");
  EXPECT_EQ(problems_of(blueprint), "");
}

TEST(PlanConnections, AllMistakesAreFoundInOneRun) {
  Blueprint blueprint = pair();
  blueprint.connect("Writer.Count", "Reader.Level");
  blueprint.connect("Writer.Degrees", "Reader.Angle");
  blueprint.connect("Writer.Three", "Reader.Two");
  blueprint.connect("Nobody.Out", "Nowhere.In");
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(blueprint, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 5u) << diagnostics.to_text();
  EXPECT_TRUE(plan.connections.empty());
}

TEST(PlanConnections, NamesAreUnique) {
  Blueprint blueprint = pair();
  blueprint.add<Writer>("Reader");
  blueprint.components.back().where = {"robot.yaml", 9, 3};
  EXPECT_EQ(problems_of(blueprint),
            "robot.yaml:9:3: error: two components are named 'Reader' (give each its own "
            "name)\n");
}

class HasMandatoryProperty final : public Component {
 public:
  using Component::Component;
  Property<double> ratio{this, "GearRatio", 0.0, "turns of the joint per turn of the motor",
                         "",   mandatory};
};

TEST(PlanProperties, APropertyWithoutADefaultMustBeGiven) {
  Blueprint blueprint;
  auto& joint = blueprint.add<HasMandatoryProperty>("Joint");
  EXPECT_EQ(problems_of(blueprint),
            "error: property 'GearRatio' of 'Joint' has no default and must be given (turns of the "
            "joint per turn of the motor)\n");
  ASSERT_TRUE(joint.ratio.set(types::Value::of(0.01)));
  EXPECT_EQ(problems_of(blueprint), "");
}

}  // namespace
}  // namespace armature::exec
