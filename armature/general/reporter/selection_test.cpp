// SPDX-License-Identifier: Apache-2.0
#include "armature/general/reporter/selection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::general {
namespace {

using component::Component;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class Joint final : public Component {
 public:
  using Component::Component;
  component::OutputPort<double> position{this, "Position", ""};
  component::OutputPort<double> velocity{this, "Velocity", ""};
  component::InputPort<double> voltage{this, "Voltage", ""};
  component::Property<double> ratio{this, "Ratio", 0.01, ""};
  component::Attribute<int> faults{this, "faults", 0, ""};
};

class Silent final : public Component {
 public:
  using Component::Component;
  component::Property<double> gain{this, "Gain", 0.0, ""};
};

class Selecting : public ::testing::Test {
 protected:
  /// The names of what is selected.
  std::vector<std::string> selected(const std::vector<std::string>& wanted) {
    Selection selection = select(wanted, {&joint1, &joint2, &part, &silent});
    objections = std::move(selection.objections);
    std::vector<std::string> names;
    for (const Source& source : selection.sources) names.push_back(source.name);
    return names;
  }
  Joint joint1{"Joint1"};
  Joint joint2{"Joint2"};
  Joint part{"Arm.Joint3"};
  Silent silent{"Silent"};
  std::vector<component::Observer::Objection> objections;
};

TEST_F(Selecting, AMemberIsAPortPropertyOrAttribute) {
  EXPECT_THAT(selected({"Joint2.Velocity", "Joint1.Voltage", "Joint1.Ratio", "Joint1.faults"}),
              ElementsAre("Joint2.Velocity", "Joint1.Voltage", "Joint1.Ratio", "Joint1.faults"));
  const Selection selection =
      select({"Joint1.Position", "Joint1.Voltage", "Joint1.Ratio"}, {&joint1});
  EXPECT_EQ(selection.sources[0].output, &face(joint1.position));
  EXPECT_EQ(selection.sources[1].input, &face(joint1.voltage));
  EXPECT_EQ(selection.sources[2].property, &joint1.ratio);
}

TEST_F(Selecting, AComponentIsAllItsOutputPorts) {
  EXPECT_THAT(selected({"Joint1"}), ElementsAre("Joint1.Position", "Joint1.Velocity"));
  EXPECT_THAT(objections, IsEmpty());
}

TEST_F(Selecting, AStarIsAnythingButADot) {
  EXPECT_THAT(selected({"Joint*.Position"}), ElementsAre("Joint1.Position", "Joint2.Position"));
  EXPECT_THAT(selected({"*.*.Position"}), ElementsAre("Arm.Joint3.Position"));
  EXPECT_THAT(selected({"Arm.*"}), ElementsAre("Arm.Joint3.Position", "Arm.Joint3.Velocity"));
  EXPECT_THAT(selected({"Joint1.*"}), SizeIs(5));
  EXPECT_THAT(selected({"*"}), SizeIs(4));
  EXPECT_THAT(objections, IsEmpty());
}

TEST_F(Selecting, WhatSeveralNamesStandForIsSelectedOnce) {
  EXPECT_THAT(selected({"Joint1.Velocity", "Joint1", "Joint1.V*"}),
              ElementsAre("Joint1.Velocity", "Joint1.Position", "Joint1.Voltage"));
}

TEST_F(Selecting, ANameThatStandsForNothingIsObjectedToWithANearOne) {
  EXPECT_THAT(selected({"Joint1", "Joint1.Positon", "Jont2.Position", "Silnt", "X*"}), SizeIs(2));
  ASSERT_THAT(objections, SizeIs(4));
  EXPECT_EQ(objections[0].message, "'Joint1.Positon' cannot be recorded");
  EXPECT_EQ(objections[0].hint, "did you mean 'Joint1.Position'?");
  EXPECT_THAT(objections[1].hint, HasSubstr("'Joint2'"));
  EXPECT_THAT(objections[2].hint, HasSubstr("'Silent'"));
  EXPECT_EQ(objections[3].message, "'X*' cannot be recorded");
}

TEST_F(Selecting, AComponentWithoutOutputPortsIsObjectedTo) {
  EXPECT_THAT(selected({"Silent"}), IsEmpty());
  ASSERT_THAT(objections, SizeIs(1));
  EXPECT_EQ(objections[0].message, "'Silent' has no output ports");
  EXPECT_THAT(objections[0].hint, HasSubstr("'Silent.*'"));
}

}  // namespace
}  // namespace armature::general
